/* SPDX-License-Identifier: Apache-2.0 */
/* Replies, written into the stream from the store and the request that the server has. */
#include "microros/rclc_parameter_reply.h"

#include "microros/rclc_parameter_descriptor.h"
#include "microros/rclc_parameter_out.h"
#include "microros/rclc_parameter_value.h"
#include "microros/rclc_parameter_reason.h"
#include "microros/rclc_parameters.h"

#include <stddef.h>

/* A result without a reason: a bool, padding, a length, a NUL, padding. */
enum { SHORTEST_RESULT = 12 };

static parameter_out_t reply_begin(uint8_t * body, uint32_t room)
{
  const parameter_out_t out = {body, 0, room, false};

  return out;
}

/* Ends a reply whose first member is a list; one with no room, or an unknown name, is empty as those of rclcpp. */
static uint32_t reply_end(parameter_out_t * out, bool known)
{
  if (out->full || !known) {
    *out = reply_begin(out->body, out->room);
    rclc_parameter_out_4(out, 0u);
  }
  return out->position;
}

/* What a reply has for each name of its request. */
typedef enum reply_part_t { REPLY_VALUE, REPLY_TYPE, REPLY_DESCRIPTOR } reply_part_t;

static uint32_t reply_of_names(const void * message, uint8_t * body, uint32_t room, reply_part_t part)
{
  const rclc_parameter_server_t * server = message;
  cdr_fault_t fault = {.field = ""};
  cdr_in_t in = rclc_parameter_request_begin(server, &fault);
  const uint32_t count = rclc_parameter_in_length(&in);
  parameter_out_t out = reply_begin(body, room);
  bool known = true;

  rclc_parameter_out_4(&out, count);
  for (uint32_t i = 0; i < count; ++i) {
    const parameter_text_t name = rclc_parameter_in_text(&in);
    const rclc_parameter_place_t * place = rclc_parameter_find(server, &name);

    known = known && (place != NULL || server->allow_undeclared_parameters);
    if (part == REPLY_VALUE) {
      rclc_parameter_out_value(&out, place);
    } else if (part == REPLY_TYPE) {
      rclc_parameter_out_1(&out, place != NULL ? place->type : (uint8_t)RCLC_PARAMETER_NOT_SET);
    } else {
      rclc_parameter_out_descriptor(&out, &name, place);
    }
  }
  return reply_end(&out, known);
}

uint32_t rclc_parameter_reply_values(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  (void)fault;
  return reply_of_names(
    message, body, rcl_interfaces__srv__GetParameters_Response__MAX_ENCODED_SIZE, REPLY_VALUE);
}

uint32_t rclc_parameter_reply_types(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  (void)fault;
  return reply_of_names(
    message, body, rcl_interfaces__srv__GetParameterTypes_Response__MAX_ENCODED_SIZE, REPLY_TYPE);
}

uint32_t rclc_parameter_reply_descriptors(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  (void)fault;
  return reply_of_names(
    message, body, rcl_interfaces__srv__DescribeParameters_Response__MAX_ENCODED_SIZE, REPLY_DESCRIPTOR);
}

/* Writes a result; its reason stays out where it would take the room of those that follow. */
static void reply_out_result(
  parameter_out_t * out, const rclc_parameter_server_t * server, const parameter_requested_t * requested,
  uint8_t outcome, uint32_t following)
{
  const uint32_t room = out->room;

  rclc_parameter_out_1(out, outcome == (uint8_t)PARAMETER_SET ? 1u : 0u);
  out->room -= following * (uint32_t)SHORTEST_RESULT;
  rclc_parameter_out_reason(out, server, requested, outcome);
  if (out->full) {
    out->full = false;
    rclc_parameter_out_text(out, "");
  }
  out->room = room;
}

/* Each entry of a request that did not arrive has the same result; more than there is room for have none. */
static uint32_t reply_cut(parameter_out_t * out, const rclc_parameter_server_t * server)
{
  static const parameter_requested_t nothing = {.name = {"", 0}, .type = (uint8_t)RCLC_PARAMETER_NOT_SET};
  const uint32_t count = server->request_cut;

  if (count > out->room / (uint32_t)SHORTEST_RESULT) {
    return reply_end(out, false);
  }
  rclc_parameter_out_4(out, count);
  for (uint32_t i = 0; i < count; ++i) {
    reply_out_result(out, server, &nothing, (uint8_t)PARAMETER_CUT, count - i - 1u);
  }
  return reply_end(out, true);
}

uint32_t rclc_parameter_reply_results(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_parameter_server_t * server = message;
  cdr_in_t in = rclc_parameter_request_begin(server, fault);
  const uint32_t count = rclc_parameter_in_length(&in);
  parameter_out_t out = reply_begin(body, rcl_interfaces__srv__SetParameters_Response__MAX_ENCODED_SIZE);

  if (server->request_cut != 0u) {
    return reply_cut(&out, server);
  }
  rclc_parameter_out_4(&out, count);
  for (uint32_t i = 0; i < count; ++i) {
    const parameter_requested_t requested = rclc_parameter_request_parameter(&in);

    reply_out_result(&out, server, &requested, server->outcomes[i], count - i - 1u);
  }
  return reply_end(&out, true);
}

uint32_t rclc_parameter_reply_result(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_parameter_server_t * server = message;
  cdr_in_t in = rclc_parameter_request_begin(server, fault);
  const uint32_t count = rclc_parameter_in_length(&in);
  parameter_out_t out =
    reply_begin(body, rcl_interfaces__srv__SetParametersAtomically_Response__MAX_ENCODED_SIZE);
  parameter_requested_t requested = {.name = {"", 0}, .type = (uint8_t)RCLC_PARAMETER_NOT_SET};
  uint8_t outcome = (uint8_t)(count == 0u ? PARAMETER_NONE : PARAMETER_SET);

  if (server->request_cut != 0u) {
    outcome = (uint8_t)PARAMETER_CUT;
  }
  for (uint32_t i = 0; i < count && outcome == (uint8_t)PARAMETER_SET; ++i) {
    requested = rclc_parameter_request_parameter(&in);
    outcome = server->outcomes[i];
  }
  reply_out_result(&out, server, &requested, outcome, 0u);
  return out.position;
}

/* Returns how many dots there are before the NUL. */
static uint64_t reply_dots(const char * name)
{
  uint64_t count = 0;

  for (uint32_t i = 0; name[i] != '\0'; ++i) {
    count += name[i] == '.' ? 1u : 0u;
  }
  return count;
}

static bool reply_is_below(const char * name, const parameter_text_t * prefix)
{
  uint32_t i = 0;

  while (i < prefix->size && name[i] != '\0' && name[i] == prefix->data[i]) {
    ++i;
  }
  return i == prefix->size && (name[i] == '.' || name[i] == '\0');
}

/* Whether a list request asks for the name: `depth` counts from the prefix that it is below; 0 is without end. */
static bool reply_lists(const rclc_parameter_server_t * server, const rclc_parameter_place_t * place)
{
  const char * name = place->name;
  cdr_fault_t fault = {.field = ""};
  cdr_in_t in = rclc_parameter_request_begin(server, &fault);
  const uint32_t count = rclc_parameter_in_length(&in);
  bool below = false;
  uint64_t least = UINT64_MAX; /* levels below one of the prefixes */
  uint64_t depth = 0;

  for (uint32_t i = 0; i < count; ++i) {
    const parameter_text_t prefix = rclc_parameter_in_text(&in);

    if (reply_is_below(name, &prefix)) {
      const uint64_t levels = name[prefix.size] == '\0' ? 0u : 1u + reply_dots(&name[prefix.size + 1u]);

      below = true;
      least = levels < least ? levels : least;
    }
  }
  cdr_get_8(&in, &depth, 1u, "depth");
  if (place->event == (uint8_t)PARAMETER_EVENT_DELETED || server->request_cut != 0u) {
    return false;
  }
  if (count == 0u) {
    return depth == 0u || reply_dots(name) < depth;
  }
  return below && (depth == 0u || least <= depth);
}

/* Returns the number of bytes before the last dot; 0 without a dot. */
static uint32_t reply_prefix(const char * name)
{
  uint32_t last = 0;

  for (uint32_t i = 0; name[i] != '\0'; ++i) {
    last = name[i] == '.' ? i : last;
  }
  return last;
}

/* Whether the prefix of the i-th parameter is one that no listed parameter before it has. */
static bool reply_prefix_is_new(const rclc_parameter_server_t * server, size_t i, uint32_t size)
{
  const parameter_text_t prefix = {server->places[i].name, size};

  for (size_t k = 0; k < i; ++k) {
    const char * other = server->places[k].name;

    if (
      reply_lists(server, &server->places[k]) && reply_prefix(other) == size &&
      reply_is_below(other, &prefix)) {
      return false;
    }
  }
  return true;
}

/* Writes the names that are listed, or their prefixes; where `out` is NULL it counts them only. */
static uint32_t reply_out_list(parameter_out_t * out, const rclc_parameter_server_t * server, bool prefixes)
{
  uint32_t count = 0;

  for (size_t i = 0; i < server->count; ++i) {
    const char * name = server->places[i].name;
    const parameter_text_t prefix = {name, reply_prefix(name)};

    if (
      !reply_lists(server, &server->places[i]) ||
      (prefixes && (prefix.size == 0u || !reply_prefix_is_new(server, i, prefix.size)))) {
      continue;
    }
    ++count;
    if (out != NULL && prefixes) {
      rclc_parameter_out_parts(out, &prefix, 1u);
    } else if (out != NULL) {
      rclc_parameter_out_text(out, name);
    } else {
      /* only counted */
    }
  }
  return count;
}

uint32_t rclc_parameter_reply_list(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_parameter_server_t * server = message;
  parameter_out_t out = reply_begin(body, rcl_interfaces__srv__ListParameters_Response__MAX_ENCODED_SIZE);

  (void)fault;
  rclc_parameter_out_4(&out, reply_out_list(NULL, server, false));
  (void)reply_out_list(&out, server, false);
  rclc_parameter_out_4(&out, reply_out_list(NULL, server, true));
  (void)reply_out_list(&out, server, true);
  return out.position;
}
