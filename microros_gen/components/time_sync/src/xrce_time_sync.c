/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_time_sync.h"

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

/* A time stamp is seconds and nanoseconds; a reply has three of them. The standard's seconds are signed
 * and would end in 2038: clocks of agents are not before 1970, so they are unsigned here. */
enum { TIME_SIZE = 8, TIMESTAMP_SIZE = 8 + TIME_SIZE, REPLY_SIZE = 3 * TIME_SIZE };
enum { TRANSMIT = 0, RECEIVE = TIME_SIZE, ORIGINATE = 2 * TIME_SIZE };

static const int64_t ns_per_s = 1000000000;

static void time_put_le32(uint8_t * at, uint32_t value)
{
  xrce_put_le16(at, (uint16_t)(value & 0xffffu));
  xrce_put_le16(&at[2], (uint16_t)(value >> 16));
}

static uint32_t time_get_u32(const uint8_t * at, uint8_t flags)
{
  const uint32_t first = xrce_get_u16(at, flags);
  const uint32_t second = xrce_get_u16(&at[2], flags);

  return (flags & XRCE_FLAG_LITTLE_ENDIAN) != 0u ? first | (second << 16) : second | (first << 16);
}

/* Returns false if the nanoseconds are a second or more. */
static bool time_get_ns(const uint8_t * at, uint8_t flags, int64_t * time_ns)
{
  const uint32_t seconds = time_get_u32(at, flags);
  const uint32_t nanoseconds = time_get_u32(&at[4], flags);

  *time_ns = (int64_t)seconds * ns_per_s + (int64_t)nanoseconds;
  return nanoseconds < (uint32_t)ns_per_s;
}

void xrce_time_sync_begin(xrce_time_sync_t * sync)
{
  if (sync->callers == 0u) {
    sync->since_ns = port_time_steady_ns();
    sync->round_trip_ns = INT64_MAX;
  }
  ++sync->callers;
}

void xrce_time_sync_end(xrce_time_sync_t * sync)
{
  if (sync->callers != 0u) { /* otherwise the session was replaced */
    --sync->callers;
  }
}

void xrce_time_sync_request(xrce_client_t * client)
{
  uint8_t message[TIMESTAMP_SIZE];
  const int64_t now_ns = port_time_steady_ns();

  xrce_put_header(message, XRCE_SESSION_ID, XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_TIMESTAMP, XRCE_FLAG_LITTLE_ENDIAN, TIME_SIZE);
  time_put_le32(&message[8], (uint32_t)(now_ns / ns_per_s));
  time_put_le32(&message[12], (uint32_t)(now_ns % ns_per_s));
  (void)xrce_session_send(&client->session, message, sizeof(message)); /* a lost message is repeated */
}

void xrce_time_sync_on_reply(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  const uint8_t flags = xrce_flags_of(submessage);
  const int64_t now_ns = port_time_steady_ns();
  xrce_time_sync_t * sync = &client->time_sync;
  int64_t transmitted_ns;
  int64_t received_ns;
  int64_t originated_ns;

  (void)now;
  if (
    size < REPLY_SIZE || !time_get_ns(&payload[TRANSMIT], flags, &transmitted_ns) ||
    !time_get_ns(&payload[RECEIVE], flags, &received_ns) ||
    !time_get_ns(&payload[ORIGINATE], flags, &originated_ns)) {
    ++client->session.statistics.malformed;
    return;
  }
  if (
    sync->callers == 0u || originated_ns < sync->since_ns || originated_ns > now_ns ||
    now_ns - originated_ns >= sync->round_trip_ns) {
    return; /* late, repeated, or less precise */
  }
  /* All times are within 2^32 seconds, so the sum of two differences stays below 2^63 nanoseconds. */
  sync->offset_ns = ((received_ns - originated_ns) + (transmitted_ns - now_ns)) / 2;
  sync->round_trip_ns = now_ns - originated_ns;
  sync->synchronized = true;
  ++sync->replies;
}
