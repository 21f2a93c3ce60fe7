/* SPDX-License-Identifier: Apache-2.0 */
/* Questions to the agent, once in a period. */
#include "microros/xrce_time_source.h"

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"

/* The clock of a small board may count milliseconds, so no round trip says more than this. */
static const int64_t source_least_ns = 250000;
static const int64_t source_most_ns = 1000000000;

static void source_answered(xrce_client_t * client)
{
  const xrce_time_sync_t * sync = &client->time_sync;
  const int64_t half_ns = sync->round_trip_ns / 2;
  xrce_time_sample_t sample;

  sample.local_ns = port_time_steady_ns();
  sample.reference_ns = sample.local_ns + sync->offset_ns;
  sample.uncertainty_ns = (half_ns < source_least_ns) ? source_least_ns : half_ns;
  if (sample.uncertainty_ns <= source_most_ns) {
    (void)xrce_time_source_take(client, &sample, sample.local_ns); /* outliers are counted */
  }
}

void xrce_time_source_step(xrce_client_t * client, uint32_t now)
{
  xrce_time_source_t * source = &client->time_source;

  if (client->session.state != (uint8_t)XRCE_READY) {
    return;
  }
  if (source->replies != client->time_sync.replies) {
    source->replies = client->time_sync.replies;
    source_answered(client);
    if (source->asks) {
      source->asks = false;
      xrce_time_sync_end(&client->time_sync);
    }
    source->due_ms = now + MICROROS_TIME_PERIOD_MS;
  } else if (xrce_is_due(now, source->due_ms)) {
    if (!source->asks) {
      source->asks = true;
      source->since_ms = now;
      xrce_time_sync_begin(&client->time_sync);
    }
    xrce_time_sync_request(client);
    source->due_ms = now + xrce_session_short_pause(now - source->since_ms);
  } else {
    /* nothing to do yet */
  }
}

uint32_t xrce_time_source_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  return (client->session.state == (uint8_t)XRCE_READY) ? xrce_sooner(left, client->time_source.due_ms, now)
                                                        : left;
}
