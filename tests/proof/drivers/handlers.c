/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the session does with one submessage: a step of an induction over submessages. The client is in any state for
 * which client_is_sound holds, as it is after xrce_session_open; the payload has any bytes and ends where its array
 * ends; what the agent hears back goes to a transport that may fail. Afterwards client_is_sound holds again.
 */
#include "proof.h"

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_stream_reliable_slots.h"
#include "microros/xrce_wire.h"

enum { RECEIVERS = XRCE_RECEIVERS };
enum { MOST_REFUSALS = 16 }; /* that xrce_entities.c counts in a row */

static xrce_client_t client;
static uint8_t submessage[XRCE_SUBMESSAGE_HEADER + LAST];
static const microros_message_type_t any_type = {.dds_type_name = "any::msg::dds_::Type_"};
static const microros_service_type_t any_service = {.dds_type_name = "any::srv::dds_::Type_"};

/*@ predicate reliable_is_sound(xrce_stream_reliable_t * s) =
      s->count <= MICROROS_RELIABLE_SLOTS && s->head < MICROROS_RELIABLE_SLOTS;
    predicate input_is_sound(xrce_stream_reliable_input_t * s) =
      \forall integer i; 0 <= i < XRCE_RELIABLE_INPUT_HELD ==> s->size[i] <= MICROROS_RELIABLE_INPUT_SLOT_SIZE; */

uint32_t port_time_ms(void)
{
  return proof_u32();
}

int64_t port_time_steady_ns(void)
{
  return Frama_C_long_long_interval(0, INT64_MAX / 2);
}

void port_sleep_ms(uint32_t duration_ms)
{
  (void)duration_ms;
}

bool xrce_plain_open(xrce_transport_t * transport)
{
  (void)transport;
  return proof_bool();
}

void xrce_plain_close(xrce_transport_t * transport)
{
  (void)transport;
}

bool xrce_plain_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  (void)transport;
  //@ check size >= 1 && \valid_read(message) && \valid_read(message + size - 1);
  (void)message;
  (void)size;
  return proof_bool();
}

int32_t xrce_plain_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  (void)transport;
  (void)buffer;
  (void)capacity;
  return 0;
}

static void any_session(void)
{
  xrce_session_t * session = &client.session;

  proof_any(&session->statistics, sizeof(session->statistics));
  session->key = proof_u32();
  session->now_ms = proof_u32();
  session->due_ms = proof_u32();
  session->received_ms = proof_u32();
  session->since_ms = proof_u32();
  session->request = proof_u16();
  session->state = (uint8_t)Frama_C_interval(XRCE_CLOSED, XRCE_CLOSING);
  session->refusal = proof_u8();
  session->transport_open = proof_bool();
  session->was_ready = proof_bool();
}

static void any_streams(void)
{
  xrce_stream_reliable_t * out = &client.reliable;
  xrce_stream_reliable_input_t * in = &client.reliable_input;

  proof_any(xrce_reliable_slots.message, sizeof(xrce_reliable_slots.message));
  out->due_ms = proof_u32();
  out->since_ms = proof_u32();
  out->held = proof_bool();
  out->count = (uint8_t)Frama_C_interval(0, MICROROS_RELIABLE_SLOTS);
  out->head = (uint8_t)Frama_C_interval(0, MICROROS_RELIABLE_SLOTS - 1);
  out->first = proof_u16();
  for (size_t i = 0; i < MICROROS_RELIABLE_SLOTS; ++i) {
    xrce_reliable_slots.size[i] =
      (uint16_t)Frama_C_interval(1, MICROROS_RELIABLE_SLOT_SIZE - MICROROS_RELIABLE_FRONT);
  }
  proof_any(in->message, sizeof(in->message));
  in->next = proof_u16();
  in->announced = proof_u16();
  in->requested = proof_u16();
  in->refused = proof_u16();
  for (size_t i = 0; i < XRCE_RELIABLE_INPUT_HELD; ++i) {
    in->sequence[i] = proof_u16();
    in->size[i] = (uint16_t)Frama_C_interval(0, MICROROS_RELIABLE_INPUT_SLOT_SIZE);
  }
  client.best_effort_input.next = proof_u16();
}

static void any_entities(void)
{
  xrce_entities_t * entities = &client.entities;

  entities->due_ms = proof_u32();
  entities->requested_ms = proof_u32();
  entities->request = proof_u16();
  entities->refused_place = proof_u16();
  entities->refused_status = proof_u8();
  entities->refusals = (uint8_t)Frama_C_interval(0, MOST_REFUSALS);
  entities->pending = (uint8_t)Frama_C_interval(XRCE_PENDING_NONE, XRCE_PENDING_ONE);
  entities->resting = proof_bool();
  for (uint16_t place = 0; place < XRCE_PLACES; ++place) {
    xrce_object_state_t * state = &client.states[place];

    state->level = (uint8_t)Frama_C_interval(0, xrce_place_complete(place));
    state->wanted = proof_bool();
    state->stale = proof_bool();
  }
  for (uint16_t i = 0; i < XRCE_ENDPOINTS; ++i) {
    const xrce_endpoint_t any = {&client, &any_type, "/any", 1, i, 0, XRCE_QOS_RELIABLE};

    client.endpoints[i] = any;
    client.endpoints[i].qos = proof_u8();
  }
  for (uint16_t i = 0; i < XRCE_SERVICES; ++i) {
    client.services[i].type = &any_service;
    client.services[i].sent = &any_type;
  }
}

static void any_receivers(void)
{
  xrce_reading_t * reading = &client.reading;

  proof_any(client.slots, sizeof(client.slots));
  proof_any(client.queues, sizeof(client.queues));
  reading->due_ms = proof_u32();
  reading->requested_ms = proof_u32();
  reading->sequence = proof_u16();
  reading->request = proof_u16();
  reading->samples = proof_u16();
  reading->receiver = (uint16_t)Frama_C_interval(0, RECEIVERS - 1);
  reading->outstanding = proof_bool();
  for (uint16_t i = 0; i < RECEIVERS; ++i) {
    xrce_receiver_t * receiver = &client.receivers[i];

    proof_any(receiver, sizeof(*receiver));
    receiver->head = (uint8_t)Frama_C_interval(0, xrce_queues[i].slots - 1);
    receiver->count = (uint8_t)Frama_C_interval(0, xrce_queues[i].slots);
    receiver->arriving = proof_bool();
  }
}

static void any_client(void)
{
  xrce_session_open(&client, proof_u32());
  client.session.in_session = proof_bool();
  client.session.transport.host = "host";
  client.participants[0].name = "any";
  client.participants[0].namespace_ = "/";
  any_session();
  any_streams();
  any_entities();
  any_receivers();
  proof_any(&client.ping.due_ms, sizeof(client.ping.due_ms));
  client.ping.unanswered = proof_u8();
  client.ping.replies = Frama_C_unsigned_char_interval(0, UINT8_MAX);
  client.time_sync.since_ns = Frama_C_long_long_interval(0, INT64_MAX / 2);
  client.time_sync.round_trip_ns = Frama_C_long_long_interval(0, INT64_MAX);
  client.time_sync.offset_ns = 0;
  client.time_sync.callers = Frama_C_unsigned_char_interval(0, UINT8_MAX);
  client.time_sync.replies = Frama_C_unsigned_char_interval(0, UINT8_MAX);
  client.time_sync.synchronized = proof_bool();
  proof_any(&client.fragments.sample, sizeof(client.fragments.sample));
  client.fragments.arrived = proof_u16();
  client.fragments.next = proof_u16();
  client.fragments.begun = proof_bool();
  client.fragments.skipping = proof_bool();
}

static void check_client(void)
{
  //@ check reliable_is_sound(&client.reliable);
  //@ check input_is_sound(&client.reliable_input);
  //@ check client.entities.cursor < XRCE_PLACES;
  //@ check client.entities.refusals <= MOST_REFUSALS;
  //@ check client.reading.receiver < RECEIVERS;
  for (uint16_t i = 0; i < RECEIVERS; ++i) {
    //@ check client.receivers[i].count <= xrce_queues[i].slots;
    //@ check client.receivers[i].head < xrce_queues[i].slots;
  }
  for (uint16_t place = 0; place < XRCE_PLACES; ++place) {
    const uint8_t complete = xrce_place_complete(place);
    //@ check client.states[place].level <= complete;
  }
}

/* --- replacements of memcpy and of functions with a separate proof (within.h) --- */

void proof_copy(void * to, const void * from, size_t size)
{
  uint8_t * const at = (uint8_t *)to;
  uint8_t * const client_begin = (uint8_t *)&client;
  const size_t place = (size_t)(at - client_begin);
  size_t end = offsetof(xrce_client_t, queues) + sizeof(client.queues);

  if (place < offsetof(xrce_client_t, fragments)) {
    end = offsetof(xrce_client_t, reliable_input) + offsetof(xrce_stream_reliable_input_t, message);
    end += sizeof(client.reliable_input.message);
  }
  //@ check place + size <= end;
  for (size_t i = 0; i < size; ++i) {
    at[i] = ((const uint8_t *)from)[i];
  }
}

bool proof_hand_on(xrce_client_t * taker, const uint8_t * message, size_t size, uint32_t now)
{
  (void)taker;
  (void)now;
  //@ check size <= MICROROS_INPUT_SIZE && \valid_read(message);
  //@ check size == 0 || \valid_read(message + size - 1);
  (void)message;
  (void)size;
  return proof_bool();
}

/* --- the inputs --- */

/* What a run tells apart: where an interval would lose what belongs together. */
typedef struct case_t {
  uint8_t kept;      /* messages of the reliable stream; 0xff: any number */
  uint8_t cursor;    /* of the entities; 0xff: any, and nothing is outstanding */
  bool deleting;     /* what is outstanding */
  uint8_t object[2]; /* least and most of the object id's low byte; its high byte is 0 */
  bool far;          /* the high byte is anything but 0 */
} case_t;

enum { ANY = 0xff };

static void take(const case_t * is, size_t size)
{
  uint8_t * const begin = &submessage[LAST - size];
  uint8_t * const payload = &begin[XRCE_SUBMESSAGE_HEADER];

  any_client();
  if (is->kept != ANY) {
    client.reliable.count = is->kept;
  }
  client.entities.deleting = is->deleting;
  client.entities.outstanding = is->cursor != ANY;
  client.entities.cursor = is->cursor;
  if (is->cursor == ANY) {
    client.entities.cursor = (uint16_t)Frama_C_interval(0, XRCE_PLACES - 1);
  } else {
    const uint8_t complete = xrce_place_complete(is->cursor);

    client.states[is->cursor].level =
      (uint8_t)Frama_C_interval(is->deleting ? 1 : 0, is->deleting ? complete : complete - 1);
  }
  proof_any(submessage, sizeof(submessage));
  begin[0] = (uint8_t)Frama_C_interval(ID_FIRST, ID_LAST);
  if (size >= XRCE_OBJECT_PREFIX && (is->far || is->object[1] != 0u)) {
    payload[2] = (uint8_t)Frama_C_interval(is->far ? 1 : 0, is->far ? UINT8_MAX : 0);
    payload[3] = (uint8_t)Frama_C_interval(is->object[0], is->object[1]);
  }
  xrce_route_submessage(&client, begin, size, proof_u32());
  check_client();
}

static void take_every_size(const case_t * is)
{
  //@ loop unroll LAST + 1;
  for (size_t size = 0; size <= (size_t)LAST; ++size) {
    take(is, size);
  }
}

static const case_t any_case = {ANY, ANY, false, {0, 0}, false};

/* STATUS: about each place, something being created or deleted there. */
static void take_about_places(void)
{
  case_t is = any_case;

  take_every_size(&is);
  for (uint8_t cursor = 0; cursor < XRCE_PLACES; ++cursor) {
    is.cursor = cursor;
    is.deleting = false;
    take_every_size(&is);
    is.deleting = true;
    take_every_size(&is);
  }
}

/* DATA: for each receiver, for what comes before and after them, and for indices that no place has. */
static void take_about_receivers(void)
{
  enum { BEGIN = MICROROS_PUBLISHERS_MAX * 16, END = BEGIN + XRCE_RECEIVERS * 16 };
  case_t is = any_case;

  is.object[1] = BEGIN - 1;
  take_every_size(&is);
  for (uint8_t low = BEGIN; low < END; low = (uint8_t)(low + 16u)) {
    is.object[0] = low;
    is.object[1] = (uint8_t)(low + 15u);
    take_every_size(&is);
  }
  is.object[0] = END;
  is.object[1] = UINT8_MAX;
  take_every_size(&is);
  is.object[0] = 0;
  is.far = true;
  take_every_size(&is);
}

/* ACKNACK: for each number of messages that are kept. */
static void take_about_kept(void)
{
  case_t is = any_case;

  for (uint8_t kept = 0; kept <= MICROROS_RELIABLE_SLOTS; ++kept) {
    is.kept = kept;
    take_every_size(&is);
  }
}

static void take_any(void)
{
  take_every_size(&any_case);
}

int main(void)
{
  CASES();
  return 0;
}
