/* SPDX-License-Identifier: Apache-2.0 */
/* The service by which the parameter server begins a session, lists parameters, and sets them. */
#include "microros/cdr.h"
#include "microros/error.h"
#include "microros/port.h"
#include "microros/rclc_parameter_descriptor.h"
#include "microros/rclc_parameter_held.h"
#include "microros/rclc_parameter_reason.h"
#include "microros/rclc_parameter_value.h"
#include "microros/rmw_client.h"
#include "microros/service_type.h"
#include "microros/text.h"
#include "microros_parameter_msgs/srv/exchange.h"

#include <stddef.h>

enum { EXCHANGE_BEGIN, EXCHANGE_LIST, EXCHANGE_LIST_CHANGES, EXCHANGE_ACKNOWLEDGE, EXCHANGE_SET };
enum { EXCHANGE_OK, EXCHANGE_OTHER_BOARD, EXCHANGE_OTHER_SESSION, EXCHANGE_OLD };
/* Start of the list of a request: the rest is kept as a separate request with the same alignment. */
enum { EXCHANGE_LIST_AT = 24 };
/* Room that a page keeps free: a bool, padding, a length and a NUL, padding of 3 bytes before. */
enum { EXCHANGE_TAIL = 16 };

static void exchange_decode(cdr_in_t * in, void * message)
{
  rclc_parameter_server_t * server = message;
  rclc_parameter_held_t * const held = &server->held;
  cdr_in_t list = *in;

  cdr_get_1(in, &held->what, 1u, "what");
  cdr_get_4(in, &held->board, 1u, "board");
  cdr_get_4(in, &held->session, 1u, "session");
  cdr_get_4(in, &held->number, 1u, "number");
  cdr_get_4(in, &held->first, 1u, "first");
  cdr_get_4(in, &held->acknowledged, 1u, "revision");
  if (in->failed) {
    return;
  }
  list.body = &in->body[EXCHANGE_LIST_AT];
  list.size = in->size - (uint32_t)EXCHANGE_LIST_AT;
  rclc_parameter_decode_parameters(&list, server);
  if (list.failed || server->request_cut != 0u) {
    cdr_in_refuse(in, CDR_FAULT_END, "parameters", list.size, 0u);
  }
  in->position = in->size;
}

static uint8_t exchange_check(const rclc_parameter_server_t * server)
{
  const rclc_parameter_held_t * const held = &server->held;

  if (held->board != rmw_client_key()) {
    return EXCHANGE_OTHER_BOARD;
  }
  if (held->what == (uint8_t)EXCHANGE_BEGIN && held->session != 0u) {
    return EXCHANGE_OK;
  }
  if (held->session != held->own_session || held->session == 0u) {
    return EXCHANGE_OTHER_SESSION;
  }
  return held->number - held->own_number - 1u < 0x7fffffffu ? EXCHANGE_OK : EXCHANGE_OLD;
}

/* Returns whether a change was made when the node had that revision; the revision may wrap. */
static bool exchange_is_known(const rclc_parameter_place_t * place, uint32_t revision)
{
  return revision - place->own_revision < 0x80000000u;
}

static void exchange_acknowledge(rclc_parameter_server_t * server, uint32_t revision)
{
  size_t i = 0;

  while (i < server->count) {
    rclc_parameter_place_t * const place = &server->places[i];
    const bool deleted = place->event == (uint8_t)PARAMETER_EVENT_DELETED;

    if (place->event != (uint8_t)PARAMETER_EVENT_NONE && exchange_is_known(place, revision)) {
      place->event = (uint8_t)PARAMETER_EVENT_NONE;
      if (deleted) {
        rclc_parameter_remove(server, place);
        continue;
      }
    }
    ++i;
  }
}

void rclc_parameter_exchange(const void * request, void * response, void * context)
{
  rclc_parameter_server_t * const server = context;
  rclc_parameter_held_t * const held = &server->held;

  (void)request;
  (void)response;
  held->status = exchange_check(server);
  if (held->status != (uint8_t)EXCHANGE_OK) {
    return;
  }
  held->own_session = held->session;
  held->own_number = held->number;
  held->wait_s = (uint8_t)RCLC_PARAMETER_HELD_FIRST_S; /* the next server is looked for soon */
  held->requested_ns = port_time_steady_ns();
  if (held->what == (uint8_t)EXCHANGE_ACKNOWLEDGE) {
    exchange_acknowledge(server, held->acknowledged);
  } else if (held->what == (uint8_t)EXCHANGE_SET) {
    held->is_setting = true;
    rclc_parameter_set_all(server);
    held->is_setting = false;
  } else {
    /* it is answered from the store */
  }
}

/* Writes the sequences of accepted values; at least two of them are empty. */
static void exchange_out_one_of(parameter_out_t * out, const rclc_parameter_place_t * place)
{
#if MICROROS_PARAMETER_ONE_OF
  for (uint8_t type = (uint8_t)RCLC_PARAMETER_INT; type <= (uint8_t)RCLC_PARAMETER_STRING; ++type) {
    const void * values = place->about->one_of;
    const uint32_t count = values != NULL && place->type == type ? (uint32_t)place->about->one_of_count : 0u;

    rclc_parameter_out_4(out, count);
    for (uint32_t i = 0; i < count; ++i) {
      if (type == (uint8_t)RCLC_PARAMETER_INT) {
        rclc_parameter_out_8(out, &((const int64_t *)values)[i]);
      } else if (type == (uint8_t)RCLC_PARAMETER_DOUBLE) {
        rclc_parameter_out_8(out, &((const double *)values)[i]);
      } else {
        rclc_parameter_out_text(out, ((const char * const *)values)[i]);
      }
    }
  }
#else
  (void)place;
  rclc_parameter_out_4(out, 0u);
  rclc_parameter_out_4(out, 0u);
  rclc_parameter_out_4(out, 0u);
#endif
}

static uint32_t exchange_size_max(const rclc_parameter_place_t * place)
{
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  if (place->type == (uint8_t)RCLC_PARAMETER_STRING) {
    return place->about->string_most;
  }
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  if (place->type >= (uint8_t)RCLC_PARAMETER_BYTE_ARRAY && place->about->array_most != UINT32_MAX) {
    return place->about->array_most;
  }
#endif
  (void)place;
  return 0u;
}

static uint32_t exchange_age_ms(const rclc_parameter_place_t * place)
{
  const uint64_t ns_per_ms = 1000000;
  uint64_t rest;
  const uint64_t age =
    rclc_parameter_divide((uint64_t)port_time_steady_ns() - (uint64_t)place->changed_ns, ns_per_ms, &rest);

  return age < UINT32_MAX ? (uint32_t)age : UINT32_MAX;
}

static void exchange_out_parameter(parameter_out_t * out, const rclc_parameter_place_t * place)
{
  const parameter_text_t name = rclc_parameter_text(place->about->name);

  rclc_parameter_out_descriptor(out, &name, place);
  rclc_parameter_out_value(out, place);
  exchange_out_one_of(out, place);
  rclc_parameter_out_4(out, exchange_size_max(place));
  rclc_parameter_out_1(out, place->event); /* its values are those of HeldParameter */
  rclc_parameter_out_4(out, exchange_age_ms(place));
}

/* Returns whether the request is for parameters, and includes this one. */
static bool exchange_lists(const rclc_parameter_held_t * held, const rclc_parameter_place_t * place)
{
  if (held->status != (uint8_t)EXCHANGE_OK || held->what > (uint8_t)EXCHANGE_LIST_CHANGES) {
    return false;
  }
  return held->what != (uint8_t)EXCHANGE_LIST_CHANGES || place->event != (uint8_t)PARAMETER_EVENT_NONE;
}

/* Writes `total`, `next` and as many parameters as fit. */
static void exchange_out_page(parameter_out_t * out, const rclc_parameter_server_t * server)
{
  const uint32_t first = server->held.what == (uint8_t)EXCHANGE_BEGIN ? 0u : server->held.first;
  const uint32_t at = cdr_aligned(out->position, 4u);
  uint32_t total = 0;
  uint32_t count = 0;
  uint32_t next;

  rclc_parameter_out_4(out, 0u);
  rclc_parameter_out_4(out, 0u);
  rclc_parameter_out_4(out, 0u);
  out->room -= (uint32_t)EXCHANGE_TAIL;
  for (size_t i = 0; i < server->count; ++i) {
    if (!exchange_lists(&server->held, &server->places[i])) {
      continue;
    }
    if (total - first == count) { /* no earlier one was left out */
      const parameter_out_t before = *out;

      exchange_out_parameter(out, &server->places[i]);
      if (out->full) {
        *out = before;
      } else {
        ++count;
      }
    }
    ++total;
  }
  out->room += (uint32_t)EXCHANGE_TAIL;
  next = first + count < total ? first + count : total;
  cdr_put_4(&out->body[at], &total);
  cdr_put_4(&out->body[at + 4u], &next);
  cdr_put_4(&out->body[at + 8u], &count);
}

/* Writes the outcome of a set; without its reason if that does not fit. */
static void exchange_out_result(parameter_out_t * out, const rclc_parameter_server_t * server)
{
  cdr_in_t in = rclc_parameter_request_begin(server);
  const uint32_t count = rclc_parameter_in_length(&in);
  parameter_requested_t requested = {.name = {"", 0}, .type = (uint8_t)RCLC_PARAMETER_NOT_SET};
  uint8_t outcome = (uint8_t)(count == 0u ? PARAMETER_NONE : PARAMETER_SET);
  const bool was_set =
    server->held.what == (uint8_t)EXCHANGE_SET && server->held.status == (uint8_t)EXCHANGE_OK;

  for (uint32_t i = 0; was_set && i < count && outcome == (uint8_t)PARAMETER_SET; ++i) {
    rclc_parameter_request_parameter(&in, &requested);
    outcome = server->outcomes[i];
  }
  rclc_parameter_out_1(out, was_set && outcome == (uint8_t)PARAMETER_SET ? 1u : 0u);
  if (was_set) {
    rclc_parameter_out_reason(out, server, &requested, outcome);
  }
  if (!was_set || out->full) {
    out->full = false;
    rclc_parameter_out_text(out, "");
  }
}

static uint32_t exchange_encode(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_parameter_server_t * server = message;
  parameter_out_t out = {body, 0, microros_parameter_msgs__srv__Exchange_Response__MAX_ENCODED_SIZE, false};

  (void)fault;
  rclc_parameter_out_1(&out, server->held.status);
  rclc_parameter_out_4(&out, rmw_client_key());
  rclc_parameter_out_4(&out, server->held.number);
  rclc_parameter_out_4(&out, server->held.own_revision);
  rclc_parameter_out_4(&out, microros_parameter_msgs__srv__Exchange_Request__MAX_ENCODED_SIZE);
  exchange_out_page(&out, server);
  exchange_out_result(&out, server);
  return out.position;
}

static const microros_message_type_t exchange_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("microros_parameter_msgs::srv::dds_::Exchange_Request_"),
  .max_encoded_size = microros_parameter_msgs__srv__Exchange_Request__MAX_ENCODED_SIZE,
  .decode = exchange_decode};
static const microros_message_type_t exchange_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("microros_parameter_msgs::srv::dds_::Exchange_Response_"),
  .max_encoded_size = microros_parameter_msgs__srv__Exchange_Response__MAX_ENCODED_SIZE,
  .encode = exchange_encode};
static const microros_service_type_t exchange_service = {
  .dds_type_name = MICROROS_FLASH_NAME("microros_parameter_msgs::srv::dds_::Exchange_"),
  .request = &exchange_request,
  .response = &exchange_response};
const rosidl_service_type_support_t rclc_parameter_exchange_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &exchange_service};
