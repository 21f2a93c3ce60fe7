/* SPDX-License-Identifier: Apache-2.0 */
/* Replies, written into the stream from the store and the request in the server. */
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

/* Ends a reply whose first member is a list; without room, or for an unknown name, the list is empty, as in rclcpp. */
static uint32_t reply_end(parameter_out_t * out, bool known)
{
  if (out->full || !known) {
    *out = reply_begin(out->body, out->room);
    rclc_parameter_out_4(out, 0u);
  }
  return out->position;
}

/* Writes the part of a reply for each name of its request. */
typedef enum reply_part_t { REPLY_VALUE, REPLY_TYPE, REPLY_DESCRIPTOR } reply_part_t;

static uint32_t reply_of_names(const void * message, uint8_t * body, uint32_t room, reply_part_t part)
{
  const rclc_parameter_server_t * server = message;
  cdr_in_t in = rclc_parameter_request_begin(server);
  const uint32_t count = rclc_parameter_in_length(&in);
  parameter_out_t out = reply_begin(body, room);
  bool misses = false;

  rclc_parameter_out_4(&out, count);
  for (uint32_t i = 0; i < count; ++i) {
    const parameter_text_t name = rclc_parameter_in_text(&in);
    const rclc_parameter_place_t * place = rclc_parameter_find(server, &name);

    if (place == NULL) {
      place = &rclc_parameter_nothing;
      misses = true;
    }
    if (part == REPLY_VALUE) {
      rclc_parameter_out_value(&out, place);
    } else if (part == REPLY_TYPE) {
      rclc_parameter_out_1(&out, place->type);
    } else {
      rclc_parameter_out_descriptor(&out, &name, place);
    }
  }
  return reply_end(&out, !misses || server->undeclared != NULL);
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

/* Writes a result; its reason is left out if later results need the room. */
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

/* Whether one of the parameters of a request was not set: only a reason takes a second look at the request. */
static bool reply_refuses(const rclc_parameter_server_t * server, uint32_t count)
{
  for (uint32_t i = 0; i < count; ++i) {
    if (server->outcomes[i] != (uint8_t)PARAMETER_SET) {
      return true;
    }
  }
  return false;
}

/* Each entry of a request that was too large to be received has the same result, as far as the reply has room. */
uint32_t rclc_parameter_reply_results(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_parameter_server_t * server = message;
  const bool is_cut = server->request_cut != 0u;
  cdr_in_t in = rclc_parameter_request_begin(server);
  const uint32_t count = is_cut ? server->request_cut : rclc_parameter_in_length(&in);
  parameter_out_t out = reply_begin(body, rcl_interfaces__srv__SetParameters_Response__MAX_ENCODED_SIZE);
  const bool fits = count <= out.room / (uint32_t)SHORTEST_RESULT;
  const bool has_reasons = is_cut || reply_refuses(server, count);

  (void)fault;
  rclc_parameter_out_4(&out, count);
  for (uint32_t i = 0; fits && i < count; ++i) {
    parameter_requested_t requested; /* read only for a reason */

    requested.name.data = "";
    requested.name.size = 0;
    requested.type = (uint8_t)RCLC_PARAMETER_NOT_SET;
    if (has_reasons) {
      rclc_parameter_request_parameter(&in, &requested); /* no name and no value of one that did not arrive */
    }
    reply_out_result(
      &out, server, &requested, is_cut ? (uint8_t)PARAMETER_CUT : server->outcomes[i], count - i - 1u);
  }
  return reply_end(&out, fits);
}

uint32_t rclc_parameter_reply_result(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_parameter_server_t * server = message;
  cdr_in_t in = rclc_parameter_request_begin(server);
  const uint32_t count = rclc_parameter_in_length(&in);
  parameter_out_t out =
    reply_begin(body, rcl_interfaces__srv__SetParametersAtomically_Response__MAX_ENCODED_SIZE);
  parameter_requested_t requested = {.name = {"", 0}, .type = (uint8_t)RCLC_PARAMETER_NOT_SET};
  uint8_t outcome = (uint8_t)(count == 0u ? PARAMETER_NONE : PARAMETER_SET);

  (void)fault;
  if (server->request_cut != 0u) {
    outcome = (uint8_t)PARAMETER_CUT;
  }
  for (uint32_t i = 0; i < count && outcome == (uint8_t)PARAMETER_SET; ++i) {
    rclc_parameter_request_parameter(&in, &requested);
    outcome = server->outcomes[i];
  }
  if (outcome == (uint8_t)PARAMETER_UNDECLARED) {
    outcome = (uint8_t)PARAMETER_SOME_UNDECLARED;
  }
  reply_out_result(&out, server, &requested, outcome, 0u);
  return out.position;
}

/* Returns how many dots there are before the NUL. */
static uint32_t reply_dots(const char * name)
{
  uint32_t count = 0;

  for (uint32_t i = 0; name[i] != '\0'; ++i) {
    count += name[i] == '.' ? 1u : 0u;
  }
  return count;
}

static bool reply_is_below(const char * name, const parameter_text_t * prefix)
{
  return rclc_parameter_begins(name, prefix) && (name[prefix->size] == '.' || name[prefix->size] == '\0');
}

/* Returns whether a list request includes the name: `depth` counts from its prefix; 0 is unlimited. */
static bool reply_lists(const rclc_parameter_server_t * server, const rclc_parameter_place_t * place)
{
  const char * name = place->about->name;
  cdr_in_t in = rclc_parameter_request_begin(server);
  const uint32_t count = rclc_parameter_in_length(&in);
  /* Levels below one of the prefixes; without any prefix, all names are below the root. */
  uint32_t least = count == 0u ? reply_dots(name) + 1u : UINT32_MAX;
  uint64_t depth = 0;

  for (uint32_t i = 0; i < count; ++i) {
    const parameter_text_t prefix = rclc_parameter_in_text(&in);

    if (reply_is_below(name, &prefix)) {
      const uint32_t levels = reply_dots(&name[prefix.size]);

      least = levels < least ? levels : least;
    }
  }
  cdr_get_8(&in, &depth, 1u, "depth");
  if (place->event == (uint8_t)PARAMETER_EVENT_DELETED || server->request_cut != 0u) {
    return false;
  }
  return least != UINT32_MAX && (depth == 0u || least <= depth);
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

/* Returns whether no listed parameter before the i-th one has the same prefix. */
static bool reply_prefix_is_new(const rclc_parameter_server_t * server, size_t i, uint32_t size)
{
  const parameter_text_t prefix = {server->places[i].about->name, size};

  for (size_t k = 0; k < i; ++k) {
    const char * other = server->places[k].about->name;

    if (
      reply_lists(server, &server->places[k]) && reply_prefix(other) == size &&
      reply_is_below(other, &prefix)) {
      return false;
    }
  }
  return true;
}

/* Writes the names that are listed, or their prefixes. */
static void reply_out_list(parameter_out_t * out, const rclc_parameter_server_t * server, bool prefixes)
{
  const uint32_t at = rclc_parameter_out_begin(out);
  uint32_t count = 0;

  for (size_t i = 0; i < server->count; ++i) {
    parameter_text_t text = rclc_parameter_text(server->places[i].about->name);

    if (!reply_lists(server, &server->places[i])) {
      continue;
    }
    if (prefixes) {
      text.size = reply_prefix(text.data);
      if (text.size == 0u || !reply_prefix_is_new(server, i, text.size)) {
        continue;
      }
    }
    rclc_parameter_out_parts(out, &text, 1u);
    ++count;
  }
  rclc_parameter_out_end(out, at, count);
}

uint32_t rclc_parameter_reply_list(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  parameter_out_t out = reply_begin(body, rcl_interfaces__srv__ListParameters_Response__MAX_ENCODED_SIZE);

  (void)fault;
  reply_out_list(&out, message, false);
  reply_out_list(&out, message, true);
  return out.position;
}
