/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_sinks.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

void xrce_sinks_set(const xrce_endpoint_t * endpoint, const xrce_sink_t * sink)
{
  endpoint->client->sinks[endpoint->index - MICROROS_PUBLISHERS_MAX] = sink;
}

static const xrce_sink_t * sinks_of(const xrce_client_t * client, const xrce_receiver_t * receiver)
{
  return client->sinks[receiver - client->receivers];
}

bool xrce_sinks_take(xrce_client_t * client, xrce_receiver_t * receiver, const xrce_sample_t * sample)
{
  const xrce_sink_t * sink = sinks_of(client, receiver);

  if (sink == NULL) {
    return false;
  }
  receiver->arriving = false; /* a partial sample is lost */
  sink->begin(sink->state, sample->big_endian);
  sink->take(sink->state, sample->data, sample->size);
  sink->end(sink->state, true);
  return true;
}

bool xrce_sinks_begin(xrce_client_t * client, const xrce_arrival_t * arrival)
{
  xrce_receiver_t * receiver = xrce_read_requested(client, arrival->request, arrival->object);
  const xrce_sink_t * sink = receiver != NULL ? sinks_of(client, receiver) : NULL;

  if (sink == NULL) {
    return false;
  }
  receiver->arriving = true;
  sink->begin(sink->state, (arrival->flags & XRCE_FLAG_LITTLE_ENDIAN) == 0u);
  return true;
}

/* Returns the receiver whose sink takes the fragments of a sample, or NULL. */
static xrce_receiver_t * sinks_arriving(xrce_client_t * client, const xrce_arrival_t * arrival)
{
  xrce_receiver_t * receiver = xrce_read_requested(client, arrival->request, arrival->object);

  return receiver != NULL && receiver->arriving && sinks_of(client, receiver) != NULL ? receiver : NULL;
}

bool xrce_sinks_add(
  xrce_client_t * client, const xrce_arrival_t * arrival, const uint8_t * bytes, size_t size)
{
  const xrce_receiver_t * receiver = sinks_arriving(client, arrival);

  if (receiver != NULL) {
    const xrce_sink_t * sink = sinks_of(client, receiver);

    sink->take(sink->state, bytes, size);
  }
  return receiver != NULL;
}

bool xrce_sinks_end(xrce_client_t * client, const xrce_arrival_t * arrival, bool complete)
{
  xrce_receiver_t * receiver = sinks_arriving(client, arrival);

  if (receiver != NULL) {
    const xrce_sink_t * sink = sinks_of(client, receiver);

    xrce_read_count(client, receiver, arrival->request);
    receiver->arriving = false;
    sink->end(sink->state, complete);
  }
  return receiver != NULL;
}
