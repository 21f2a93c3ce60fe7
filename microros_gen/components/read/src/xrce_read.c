/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_read.h"

#include "microros/xrce_client.h"
#include "microros/xrce_read_grant.h"
#include "microros/xrce_sinks.h"
#include "microros/xrce_wire.h"

/* Message header, submessage header, request id, object id; then the specification (OMG DDS-XRCE 1.0, 8.3.5.9). */
enum {
  READ_REQUEST_AT = 8,
  READ_OBJECT_AT = 10,
  STREAM_AT = 12,
  READ_FORMAT_AT = 13,
  CONTROLLED_AT = 15,
  SAMPLES_AT = 16,
  BYTES_AT = 20,
  READ_DATA_MESSAGE = 24,
  READ_STATUS_SIZE = 6
};

static const uint16_t samples_unlimited = 0xffffu;

static uint16_t read_index(const xrce_client_t * client, const xrce_receiver_t * receiver)
{
  return (uint16_t)(receiver - client->receivers);
}

static uint16_t read_place(uint16_t index)
{
  return (uint16_t)(XRCE_READERS_AT + index);
}

/* Returns the id of the object that a receiver reads from. */
static uint16_t read_object(uint16_t index)
{
  const uint16_t place = read_place(index);
  uint8_t kind = XRCE_KIND_DATAREADER;

  if (xrce_place_is_service(place)) {
    kind = place < XRCE_REQUESTERS_AT ? (uint8_t)XRCE_KIND_REPLIER : (uint8_t)XRCE_KIND_REQUESTER;
  }
  return xrce_object_id((uint16_t)(place - MICROROS_NODES_MAX), kind);
}

const xrce_queue_t * xrce_read_queue(const xrce_client_t * client, const xrce_receiver_t * receiver)
{
  return &xrce_queues[read_index(client, receiver)];
}

static bool read_is_reliable(const xrce_client_t * client, uint16_t index)
{
  return (client->endpoints[read_place(index) - MICROROS_NODES_MAX].qos & XRCE_QOS_RELIABLE) != 0u;
}

bool xrce_read_is_reliable(const xrce_client_t * client, const xrce_receiver_t * receiver)
{
  return read_is_reliable(client, read_index(client, receiver));
}

xrce_receiver_t * xrce_read_find(xrce_client_t * client, uint16_t object)
{
  const uint16_t index = (uint16_t)(xrce_object_index(object) - MICROROS_PUBLISHERS_MAX);

  if (index >= XRCE_RECEIVERS || read_object(index) != object || !client->states[read_place(index)].wanted) {
    return NULL;
  }
  return &client->receivers[index];
}

/* Sends the outstanding READ_DATA; a repetition has the same bytes, so the agent executes it once. */
static void read_send(xrce_client_t * client, uint32_t now)
{
  xrce_reading_t * reading = &client->reading;
  uint8_t message[READ_DATA_MESSAGE];

  xrce_put_header(message, XRCE_SESSION_ID, XRCE_STREAM_READING, reading->sequence);
  xrce_put_submessage(&message[4], XRCE_READ_DATA, XRCE_FLAG_LITTLE_ENDIAN, READ_DATA_MESSAGE - 8);
  xrce_put_be16(&message[READ_REQUEST_AT], reading->request);
  xrce_put_be16(&message[READ_OBJECT_AT], read_object(reading->receiver));
  message[STREAM_AT] = 0;
  if (reading->samples != 0u) {
    message[STREAM_AT] = read_is_reliable(client, reading->receiver) ? (uint8_t)XRCE_STREAM_RELIABLE
                                                                     : (uint8_t)XRCE_STREAM_BEST_EFFORT;
  }
  xrce_put_le16(&message[READ_FORMAT_AT], 0); /* that of XRCE_READ_FORMATS, without a content filter */
  message[CONTROLLED_AT] = 1;
  xrce_put_le32(&message[SAMPLES_AT], reading->samples); /* limited by nothing else: elapsed time 0, */
  xrce_put_le32(&message[BYTES_AT], 0);                  /* and bytes and pace 0 */
  reading->due_ms = now + xrce_session_short_pause(now - reading->requested_ms);
  (void)xrce_session_send(&client->session, message, sizeof(message)); /* a lost message is repeated */
}

/* Returns how many samples to request; 0: none. */
static uint16_t read_samples(const xrce_client_t * client, uint16_t index)
{
  const xrce_receiver_t * receiver = &client->receivers[index];

  if (!read_is_reliable(client, index)) {
    return receiver->request == XRCE_REQUEST_NONE ? samples_unlimited : 0u;
  }
  return receiver->granted == 0u ? xrce_read_grant(index, xrce_read_room(client, receiver)) : 0u;
}

/*
 * Returns whether a receiver waits for samples that it requested, as most of them do: each pump looks at all receivers.
 * A preconfigured one may have been closed meanwhile. */
static bool read_waits(const xrce_receiver_t * receiver)
{
  return MICROROS_PRECONFIGURED == 0u && receiver->granted != 0u;
}

/* Returns whether a receiver needs a READ_DATA, and for how many samples. Preconfigured entities still
 * exist at the agent when they are closed here: 0 samples tell the agent to stop. */
static bool read_needs_request(xrce_client_t * client, uint16_t index, uint32_t now, uint16_t * samples)
{
  xrce_receiver_t * receiver = &client->receivers[index];
  const xrce_object_state_t * state = &client->states[read_place(index)];

  *samples = 0;
  if (!state->wanted) {
    return MICROROS_PRECONFIGURED != 0u && receiver->request != XRCE_REQUEST_NONE;
  }
  if (receiver->resting) {
    receiver->resting = !xrce_is_due(now, receiver->due_ms);
  }
  if (receiver->resting || state->stale || state->level != xrce_place_complete(read_place(index))) {
    return false;
  }
  if (xrce_place_is_local(read_place(index))) {
    return false; /* complete without objects that could be read from */
  }
  *samples = read_samples(client, index);
  return *samples != 0u;
}

static void read_begin(xrce_client_t * client, uint16_t samples, uint32_t now)
{
  xrce_reading_t * reading = &client->reading;
  xrce_receiver_t * receiver = &client->receivers[reading->receiver];

  reading->outstanding = true;
  reading->requested_ms = now;
  reading->request = xrce_session_next_request(&client->session);
  reading->samples = samples;
  if (receiver->request != XRCE_REQUEST_NONE) {
    receiver->before = receiver->request;
  }
  receiver->request = samples != 0u ? reading->request : (uint16_t)XRCE_REQUEST_NONE;
  receiver->granted = samples != samples_unlimited ? samples : 0u;
  read_send(client, now);
}

void xrce_read_step(xrce_client_t * client, uint32_t now)
{
  xrce_reading_t * reading = &client->reading;
  uint32_t index = reading->receiver;
  uint16_t samples;

  if (client->session.state != XRCE_READY) {
    return;
  }
  if (reading->outstanding) {
    if (xrce_is_due(now, reading->due_ms)) {
      read_send(client, now);
    }
    return;
  }
  for (uint32_t i = 0; i < (uint32_t)XRCE_RECEIVERS; ++i) {
    ++index;
    /* cppcheck-suppress knownConditionTrueFalse ; a plan with one receiver has no other */
    index = index < XRCE_RECEIVERS ? index : 0u;
    if (
      !read_waits(&client->receivers[index]) && read_needs_request(client, (uint16_t)index, now, &samples)) {
      reading->receiver = (uint16_t)index;
      read_begin(client, samples, now);
      return;
    }
  }
}

void xrce_read_renew(xrce_client_t * client)
{
  client->reading.outstanding = false;
  client->reading.sequence = 0;
  for (uint16_t i = 0; i < (uint16_t)XRCE_RECEIVERS; ++i) {
    xrce_receiver_t * receiver = &client->receivers[i];

    if (receiver->request != XRCE_REQUEST_NONE) {
      receiver->before = receiver->request; /* an agent that still knows the session continues the old one */
    }
    receiver->request = XRCE_REQUEST_NONE;
    receiver->granted = 0;
    receiver->resting = false;
  }
}

/* Called when the agent has the outstanding READ_DATA. */
static void read_arrived(xrce_reading_t * reading)
{
  reading->outstanding = false;
  ++reading->sequence;
}

void xrce_read_on_acknack(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_reading_t * reading = &client->reading;

  (void)now;
  if (
    size >= XRCE_ACKNACK_SIZE && payload[4] == XRCE_STREAM_READING && client->session.state == XRCE_READY &&
    reading->outstanding &&
    xrce_get_u16(&payload[0], xrce_flags_of(submessage)) == (uint16_t)(reading->sequence + 1u)) {
    read_arrived(reading);
  }
}

void xrce_read_on_status(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_reading_t * reading = &client->reading;
  xrce_receiver_t * receiver;
  uint16_t request;

  if (size < READ_STATUS_SIZE || client->session.state != XRCE_READY) {
    return;
  }
  request = xrce_get_be16(&payload[0]);
  if (reading->outstanding && request == reading->request) {
    read_arrived(reading);
  }
  if (payload[4] <= XRCE_STATUS_OK_MATCHED) {
    return; /* as nearly always, and mostly of a CREATE */
  }
  receiver = xrce_read_find(client, xrce_get_be16(&payload[2]));
  if (receiver != NULL && request == receiver->request) {
    receiver->status = payload[4];
    receiver->request = XRCE_REQUEST_NONE;
    receiver->granted = 0;
    receiver->due_ms = now + MICROROS_RETRY_MOST_MS;
    receiver->resting = true;
    ++client->session.statistics.refused;
  }
}

static void read_refuse(xrce_client_t * client, xrce_receiver_t * receiver, uint16_t size)
{
  receiver->large = size;
  ++receiver->refused;
  ++client->session.statistics.dropped;
}

void xrce_read_count(xrce_client_t * client, xrce_receiver_t * receiver, uint16_t request)
{
  if (request != receiver->request) {
    return;
  }
  if (client->reading.outstanding && request == client->reading.request) {
    read_arrived(&client->reading); /* its acknowledgement was lost or is late */
  }
  if (receiver->granted != 0u) {
    --receiver->granted;
  }
}

xrce_receiver_t * xrce_read_requested(xrce_client_t * client, uint16_t request, uint16_t object)
{
  xrce_receiver_t * receiver = xrce_read_find(client, object);

  if (
    receiver == NULL || request == XRCE_REQUEST_NONE ||
    (request != receiver->request && request != receiver->before)) {
    return NULL;
  }
  return receiver;
}

void xrce_read_on_data(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_sample_t sample;
  xrce_receiver_t * receiver;
  uint16_t request;

  if (size <= XRCE_OBJECT_PREFIX || (xrce_flags_of(submessage) & XRCE_READ_FORMATS) != 0u) {
    ++client->session.statistics.malformed;
    return;
  }
  request = xrce_get_be16(&payload[0]);
  receiver = xrce_read_requested(client, request, xrce_get_be16(&payload[2]));
  if (receiver == NULL) {
    return;
  }
  xrce_read_count(client, receiver, request);
  sample.data = &payload[XRCE_OBJECT_PREFIX];
  sample.arrived_ms = now;
  sample.size = (uint16_t)(size - XRCE_OBJECT_PREFIX);
  sample.big_endian = (xrce_flags_of(submessage) & XRCE_FLAG_LITTLE_ENDIAN) == 0u;
  if (xrce_sinks_take(client, receiver, &sample)) {
    return;
  }
  if (sample.size > xrce_read_largest(client, receiver)) {
    read_refuse(client, receiver, sample.size);
  } else {
    xrce_read_keep(client, receiver, &sample, xrce_read_is_reliable(client, receiver));
  }
}

void xrce_read_refuse(xrce_client_t * client, uint16_t request, uint16_t object, uint16_t size)
{
  xrce_receiver_t * receiver = xrce_read_requested(client, request, object);

  if (receiver != NULL) {
    xrce_read_count(client, receiver, request);
    read_refuse(client, receiver, size);
  }
}
