/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Requests are kept in their encoded form: checked when they arrive, copied once, and read again when they are
 * answered. So names have no limit, and no decoded message takes memory.
 *
 * Of a request that is too large, only the length of its list is received.
 */
#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameters.h"

#include <string.h>

/* Moves past what follows the numbers of a parameter, and notes its string or array where a server can hold them. */
static void request_rest(cdr_in_t * in, parameter_requested_t * requested)
{
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  requested->string = rclc_parameter_in_text(in);
#else
  rclc_parameter_in_pass_text(in);
#endif
  rclc_parameter_array_request(in, requested);
}

void rclc_parameter_request_parameter(cdr_in_t * in, parameter_requested_t * requested)
{
  rclc_parameter_scalar_t numbers[2] = {
    {.integer_value = 0}, {.integer_value = 0}}; /* an integer, a double */
  const uint8_t * bytes;
  bool truth = false;

  requested->type = (uint8_t)RCLC_PARAMETER_NOT_SET;
  requested->name = rclc_parameter_in_text(in);
  bytes = rclc_parameter_in_take(in, 2u, 1u);
  if (bytes != NULL) {
    requested->type = bytes[0];
    truth = bytes[1] != 0u;
  }
  cdr_get_8(in, numbers, 2u, "message");
  request_rest(in, requested);
  requested->value = numbers[requested->type == (uint8_t)RCLC_PARAMETER_DOUBLE ? 1 : 0];
  if (requested->type == (uint8_t)RCLC_PARAMETER_BOOL) {
    requested->value.bool_value = truth;
  }
}

cdr_in_t rclc_parameter_request_begin(const rclc_parameter_server_t * server)
{
  static cdr_fault_t fault;
  const cdr_in_t in = {server->request, server->request_size, 0, server->request_swaps, false, &fault};

  return in;
}

/* Returns whether a request arrived without the entries of its list, and stores their number. */
static bool request_cut(const cdr_in_t * in, rclc_parameter_server_t * server)
{
  cdr_in_t list = *in;
  uint32_t count = 0;

  if (in->size == sizeof(count)) {
    cdr_get_4(&list, &count, 1u, "message");
  }
  server->request_cut = count;
  server->request_size = 0; /* until it is kept */
  return count != 0u;
}

/* Copies a request that was read to its end. */
static void request_keep(cdr_in_t * in, rclc_parameter_server_t * server)
{
  if (in->failed) {
    return;
  }
  if (in->size > sizeof(server->request)) {
    cdr_in_refuse(in, CDR_FAULT_VALUE, "message", in->size, sizeof(server->request));
    return;
  }
  (void)memcpy(server->request, in->body, (size_t)in->size);
  server->request_size = in->size;
  server->request_swaps = in->swap;
}

void rclc_parameter_decode_names(cdr_in_t * in, void * server)
{
  if (!request_cut(in, server)) {
    (void)rclc_parameter_in_pass_texts(in);
    request_keep(in, server);
  }
}

void rclc_parameter_decode_list(cdr_in_t * in, void * server)
{
  uint64_t depth;

  if (!request_cut(in, server)) {
    (void)rclc_parameter_in_pass_texts(in);
    cdr_get_8(in, &depth, 1u, "message");
    request_keep(in, server);
  }
}

void rclc_parameter_decode_parameters(cdr_in_t * in, void * server)
{
  parameter_requested_t passed = {.type = (uint8_t)RCLC_PARAMETER_NOT_SET};
  uint32_t count;

  if (request_cut(in, server)) {
    return;
  }
  count = rclc_parameter_in_length(in);
  for (uint32_t i = 0; i < count && !in->failed; ++i) {
    rclc_parameter_in_pass_text(in);          /* the name */
    (void)rclc_parameter_in_take(in, 2u, 1u); /* the type, and a bool */
    (void)rclc_parameter_in_take(in, 2u, 8u); /* an integer, and a double */
    request_rest(in, &passed);
  }
  request_keep(in, server);
}
