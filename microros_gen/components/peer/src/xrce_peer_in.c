/* SPDX-License-Identifier: Apache-2.0 */
/* What arrives in the session of the other board, of which this one is the agent. */
#include "microros/xrce_client.h"
#include "microros/xrce_peer.h"
#include "microros/xrce_peer_calling.h"
#include "microros/xrce_peer_fragments.h"
#include "microros/xrce_peer_serving.h"
#include "microros/xrce_read.h"
#include "microros/xrce_wire.h"

enum {
  ACKNACK_MESSAGE = XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER + XRCE_ACKNACK_SIZE,
  RESET_MESSAGE = XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER
};

/* An ACKNACK has this many bits, and nobody sends more messages ahead. Numbers from half of 2^16 on are old. */
enum { WINDOW = 16, HALF = 0x8000, OLD = 64 };

void xrce_peer_in_reset(xrce_peer_t * peer, uint8_t index)
{
  xrce_peer_fragments_reset(index);
  peer->next = 0;
  peer->newest = UINT16_MAX; /* 0 is newer */
  peer->received = false;
  peer->early = false;
  peer->requested = false;
}

void xrce_peer_in_closed(const xrce_endpoint_t * endpoint)
{
  for (uint8_t link = 0; link < MICROROS_PEERS; ++link) {
    const xrce_peer_line_t * line = &xrce_peer_lines[link];

    for (uint16_t i = 0; i < line->reader_count; ++i) { /* at most MICROROS_SUBSCRIPTIONS_MAX rounds */
      if ((uint32_t)line->readers[i].endpoint + MICROROS_PUBLISHERS_MAX == endpoint->index) {
        endpoint->client->peers[link].begun = true;
      }
    }
  }
}

/* Answers a message of this session. */
static void in_send_reset(xrce_client_t * client, uint8_t index, uint8_t session)
{
  uint8_t message[RESET_MESSAGE];

  xrce_put_header(message, session, XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_RESET, XRCE_FLAG_LITTLE_ENDIAN, 0);
  (void)xrce_peer_send(client, index, message, sizeof(message)); /* the next message is answered again */
}

/* Acknowledges up to the next message, and asks for `known` messages from that one on. */
static void in_acknowledge(xrce_client_t * client, uint8_t index, uint16_t known)
{
  const uint32_t missing = known < WINDOW ? ((uint32_t)1u << known) - 1u : 0xffffu;
  const xrce_peer_t * peer = &client->peers[index];
  uint8_t message[ACKNACK_MESSAGE];

  xrce_put_header(message, xrce_peer_other(peer, &xrce_peer_lines[index]), XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_ACKNACK, XRCE_FLAG_LITTLE_ENDIAN, XRCE_ACKNACK_SIZE);
  xrce_put_le16(&message[8], peer->next);
  xrce_put_be16(&message[10], (uint16_t)missing);
  message[12] = XRCE_STREAM_RELIABLE;
  (void)xrce_peer_send(client, index, message, sizeof(message)); /* a HEARTBEAT asks again */
}

static bool in_is_open(const xrce_client_t * client, uint16_t subscription)
{
  return client->states[XRCE_READERS_AT + subscription].wanted;
}

static bool in_is_topic(const xrce_peer_route_t * reader, uint16_t object)
{
  return xrce_object_id(reader->topic, XRCE_KIND_DATAWRITER) == object;
}

/* Stores a sample for a subscription. A full queue drops its oldest one: what is acknowledged here has arrived at the
 * board, and nothing holds the other subscriptions of the link back. */
static void in_store(xrce_client_t * client, uint16_t subscription, const xrce_sample_t * sample)
{
  xrce_receiver_t * receiver = &client->receivers[subscription];

  if (sample->size > xrce_read_largest(client, receiver)) {
    receiver->large = sample->size;
    ++receiver->refused;
    ++client->session.statistics.dropped;
  } else {
    xrce_read_keep(client, receiver, sample, false);
  }
}

static void in_write_data(
  xrce_client_t * client, uint8_t index, const uint8_t * submessage, size_t size, uint32_t now)
{
  const xrce_peer_line_t * line = &xrce_peer_lines[index];
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_sample_t sample;
  uint16_t object;

  if (size <= XRCE_OBJECT_PREFIX || (xrce_flags_of(submessage) & XRCE_READ_FORMATS) != 0u) {
    ++client->session.statistics.malformed;
    return;
  }
  object = xrce_get_be16(&payload[2]);
  sample.data = &payload[XRCE_OBJECT_PREFIX];
  sample.arrived_ms = now;
  sample.size = (uint16_t)(size - XRCE_OBJECT_PREFIX);
  sample.big_endian = (xrce_flags_of(submessage) & XRCE_FLAG_LITTLE_ENDIAN) == 0u;
  for (uint16_t i = 0; i < line->reader_count; ++i) { /* at most MICROROS_SUBSCRIPTIONS_MAX rounds */
    if (!in_is_topic(&line->readers[i], object)) {
      continue;
    }
    if (in_is_open(client, line->readers[i].endpoint)) {
      in_store(client, line->readers[i].endpoint, &sample);
    } else if (xrce_peer_input(index)[MICROROS_PEER_HEAD + 1u] == (uint8_t)XRCE_STREAM_RELIABLE) {
      ++client->session.statistics.dropped; /* it was acknowledged */
    } else {
      /* nobody expects it */
    }
  }
}

/* Returns whether the program has yet to open a subscription of what begins with this submessage. */
static bool in_has_no_reader(const xrce_client_t * client, uint8_t index, const uint8_t * submessage)
{
  const xrce_peer_line_t * line = &xrce_peer_lines[index];

  if (submessage[0] != XRCE_WRITE_DATA || xrce_get_le16(&submessage[2]) < XRCE_OBJECT_PREFIX) {
    return false;
  }
  for (uint16_t i = 0; i < line->reader_count; ++i) { /* at most MICROROS_SUBSCRIPTIONS_MAX rounds */
    if (
      in_is_topic(&line->readers[i], xrce_get_be16(&xrce_payload_of(submessage)[2])) &&
      !in_is_open(client, line->readers[i].endpoint)) {
      return true;
    }
  }
  return false;
}

/* Decides whether the next reliable message waits in the other board, which repeats it with its HEARTBEATs. */
static bool in_is_early(xrce_client_t * client, uint8_t index, const uint8_t * message, uint32_t now)
{
  xrce_peer_t * peer = &client->peers[index];

  if (
    peer->begun ||
    !in_has_no_reader(client, index, xrce_peer_fragments_front(index, &message[XRCE_MESSAGE_HEADER]))) {
    return false;
  }
  if (!peer->early) {
    peer->early_ms = now;
  }
  peer->begun = xrce_is_due(now, peer->early_ms + XRCE_PEER_EARLY_MS);
  return !peer->begun;
}

static void in_heartbeat(xrce_client_t * client, uint8_t index, const uint8_t * submessage, size_t size)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_peer_t * peer = &client->peers[index];
  uint16_t ahead;
  uint16_t known;

  if (size < XRCE_HEARTBEAT_SIZE || payload[4] != XRCE_STREAM_RELIABLE) {
    ++client->session.statistics.malformed;
    return;
  }
  ahead = (uint16_t)(xrce_get_u16(&payload[0], xrce_flags_of(submessage)) - peer->next);
  if (ahead != 0u && ahead < HALF) {
    /* the other board has forgotten what is missing here */
    in_send_reset(client, index, xrce_peer_other(peer, &xrce_peer_lines[index]));
    return;
  }
  known = (uint16_t)(xrce_get_u16(&payload[2], xrce_flags_of(submessage)) - peer->next + 1u);
  if (known >= (uint16_t)HALF) {
    known = 0;
  } else if (peer->early && known > 1u) {
    known = 1; /* what follows is not stored anyway */
  } else {
    /* all of them */
  }
  in_acknowledge(client, index, known);
}

/* Takes the submessages of the message at MICROROS_PEER_HEAD of a buffer, in order. */
static void in_deliver(xrce_client_t * client, uint8_t index, uint8_t * input, size_t size, uint32_t now)
{
  const uint8_t * message = &input[MICROROS_PEER_HEAD];
  size_t at = XRCE_MESSAGE_HEADER;

  /* at most MICROROS_PEER_MTU / 4 + MICROROS_PEER_JOINED / 4 or MICROROS_PEER_MTU / 4 rounds */
  while (at < size) {
    const uint8_t * submessage = &message[at];
    const size_t length = xrce_get_le16(&submessage[2]);

    if (submessage[0] == XRCE_WRITE_DATA) {
      if (
        !xrce_peer_serving_take(client, index, input, at, now) &&
        !xrce_peer_calling_take(client, index, input, at, now)) {
        in_write_data(client, index, submessage, length, now);
      }
    } else if (submessage[0] == XRCE_HEARTBEAT) {
      in_heartbeat(client, index, submessage, length);
    } else {
      ++client->session.statistics.malformed;
    }
    at = (at + XRCE_SUBMESSAGE_HEADER + length + 3u) & ~(size_t)3u;
  }
}

/* Asks for all messages from the next one on: only that one would have been stored. Once for each gap, and then as often
 * as a HEARTBEAT asks: each of the messages after the gap arrives too, and the answers would fill a slow line. */
static void in_report_gap(xrce_client_t * client, uint8_t index)
{
  xrce_peer_t * peer = &client->peers[index];

  if (!peer->requested) {
    peer->requested = true;
    in_acknowledge(client, index, WINDOW);
  }
}

static void in_take_reliable(
  xrce_client_t * client, uint8_t index, const uint8_t * message, size_t size, uint32_t now)
{
  xrce_peer_t * peer = &client->peers[index];
  const uint16_t ahead = (uint16_t)(xrce_get_le16(&message[2]) - peer->next);

  if (ahead == 0u) {
    peer->early = in_is_early(client, index, message, now);
  }
  if (peer->early && ahead < WINDOW) {
    return; /* an ACKNACK would ask for them again at once */
  }
  if (ahead == 0u) {
    size_t whole = size;
    uint8_t * input = xrce_peer_fragments_join(client, index, &whole);

    ++peer->next;
    peer->requested = false;
    if (input != NULL) {
      in_deliver(client, index, input, whole, now);
    }
  }
  if (ahead == 0u || ahead >= HALF) {
    in_acknowledge(client, index, 0);
  } else if (ahead < WINDOW) {
    in_report_gap(client, index);
  } else {
    in_send_reset(client, index, message[0]);
  }
}

void xrce_peer_in_take(
  xrce_client_t * client, uint8_t index, const uint8_t * message, size_t size, uint32_t now)
{
  xrce_peer_t * peer = &client->peers[index];
  const uint16_t number = xrce_get_le16(&message[2]);

  if (peer->other_key == 0u || message[0] != xrce_peer_other(peer, &xrce_peer_lines[index])) {
    in_send_reset(client, index, message[0]);
    return;
  }
  peer->received = true;
  if (message[1] == XRCE_STREAM_RELIABLE) {
    in_take_reliable(client, index, message, size, now);
  } else if (message[1] == XRCE_STREAM_NONE) {
    in_deliver(client, index, xrce_peer_input(index), size, now);
  } else if (message[1] == XRCE_STREAM_BEST_EFFORT) {
    /* A number further behind is a new one after a long silence: neither that nor a forged one may block half of them. */
    if ((uint16_t)(peer->newest - number) >= (uint16_t)OLD) {
      peer->newest = number;
      in_deliver(client, index, xrce_peer_input(index), size, now);
    }
  } else {
    ++client->session.statistics.malformed;
  }
}
