/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_continuous.h"

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_rest.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_write.h"

#include <string.h>

enum { STREAM_CONTINUOUS = 0x83 };

/* Sends the outstanding message; a repetition has the same bytes. What the line refuses is tried in the next pump. */
static void continuous_transmit(xrce_client_t * client, uint32_t now)
{
  xrce_continuous_t * continuous = &client->continuous;

  continuous->due_ms = now;
  if (xrce_session_send(&client->session, &continuous->message[continuous->from], continuous->size)) {
    continuous->due_ms = now + xrce_session_short_pause(now - continuous->sent_ms);
  }
}

/* Makes the first `size` bytes after the front the outstanding message. */
static void continuous_put(xrce_client_t * client, size_t size, bool is_last, uint32_t now)
{
  xrce_continuous_t * continuous = &client->continuous;
  const uint32_t flags =
    is_last ? XRCE_FLAG_LITTLE_ENDIAN | XRCE_FLAG_LAST_FRAGMENT : XRCE_FLAG_LITTLE_ENDIAN;

  continuous->from = 0;
  if (is_last && continuous->busy && !continuous->begun) {
    continuous->from = XRCE_SUBMESSAGE_HEADER; /* a whole message needs no FRAGMENT */
  }
  continuous->size = (uint16_t)(XRCE_CONTINUOUS_FRONT + size - continuous->from);
  xrce_put_submessage(
    &continuous->message[XRCE_MESSAGE_HEADER], XRCE_FRAGMENT, (uint8_t)flags, (uint16_t)size);
  xrce_put_header(
    &continuous->message[continuous->from], XRCE_SESSION_ID, STREAM_CONTINUOUS, continuous->sequence);
  continuous->outstanding = true;
  continuous->sent_ms = now;
  continuous_transmit(client, now);
}

/* Rests between two pumps; returns whether the limit has passed. */
static bool continuous_is_late(const xrce_client_t * client, uint32_t start)
{
  if (port_time_ms() - start >= XRCE_CONTINUOUS_TIMEOUT_MS) {
    return true;
  }
  xrce_rest(client);
  return false;
}

static bool continuous_has_session(const xrce_endpoint_t * writer)
{
  return !writer->client->continuous.lost && xrce_write_failure(writer) != XRCE_WRITE_NO_SESSION;
}

xrce_continuous_outcome_t xrce_continuous_begin(const xrce_endpoint_t * writer)
{
  const uint32_t start = port_time_ms();
  xrce_client_t * client = writer->client;
  xrce_continuous_t * continuous = &client->continuous;

  for (;;) {
    xrce_session_pump(client);
    if (xrce_write_failure(writer) == XRCE_WRITE_NO_SESSION) {
      return XRCE_CONTINUOUS_LOST;
    }
    if (
      !continuous->busy && !continuous->outstanding && !continuous->broken &&
      xrce_route_unacknowledged(client) == 0u) {
      continuous->busy = true;
      continuous->begun = false;
      continuous->lost = false;
      return XRCE_CONTINUOUS_DONE;
    }
    if (continuous_is_late(client, start)) {
      return XRCE_CONTINUOUS_TIMEOUT;
    }
  }
}

xrce_continuous_outcome_t xrce_continuous_send(const xrce_endpoint_t * writer, size_t size, bool is_last)
{
  const uint32_t start = port_time_ms();
  xrce_client_t * client = writer->client;
  xrce_continuous_t * continuous = &client->continuous;

  if (!continuous_has_session(writer)) { /* lost while the application wrote */
    return XRCE_CONTINUOUS_LOST;
  }
  continuous_put(client, size, is_last, start);
  continuous->begun = true;
  for (;;) {
    xrce_session_pump(client);
    if (!continuous_has_session(writer)) {
      return XRCE_CONTINUOUS_LOST;
    }
    if (!continuous->outstanding) {
      return XRCE_CONTINUOUS_DONE;
    }
    if (continuous_is_late(client, start)) {
      return XRCE_CONTINUOUS_TIMEOUT;
    }
  }
}

void xrce_continuous_end(xrce_client_t * client, bool is_whole)
{
  xrce_continuous_t * continuous = &client->continuous;

  continuous->broken = continuous->broken || (continuous->begun && !is_whole);
  continuous->busy = false;
}

void xrce_continuous_step(xrce_client_t * client, uint32_t now)
{
  const xrce_continuous_t * continuous = &client->continuous;

  if (client->session.state != (uint8_t)XRCE_READY) {
    return;
  }
  if (continuous->outstanding) {
    if (xrce_is_due(now, continuous->due_ms)) {
      continuous_transmit(client, now);
    }
  } else if (continuous->broken && !continuous->busy) {
    continuous_put(client, 0, true, now);
    client->continuous.broken = false;
  } else {
    /* nothing to send */
  }
}

void xrce_continuous_on_acknack(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_continuous_t * continuous = &client->continuous;

  (void)now;
  if (
    size < XRCE_ACKNACK_SIZE || payload[4] != (uint8_t)STREAM_CONTINUOUS || !continuous->outstanding ||
    client->session.state != (uint8_t)XRCE_READY ||
    xrce_get_u16(&payload[0], xrce_flags_of(submessage)) != (uint16_t)(continuous->sequence + 1u)) {
    return;
  }
  continuous->outstanding = false;
  ++continuous->sequence;
}

void xrce_continuous_renew(xrce_client_t * client)
{
  xrce_continuous_t * continuous = &client->continuous;

  /* What is outstanding may be the end of an abandoned message. */
  continuous->broken =
    continuous->broken || continuous->outstanding || (continuous->busy && continuous->begun);
  continuous->lost = continuous->busy;
  continuous->outstanding = false;
  continuous->sequence = 0;
}

void xrce_continuous_wake(xrce_client_t * client)
{
  (void)memset(client->continuous_callbacks, 0, sizeof(client->continuous_callbacks));
}
