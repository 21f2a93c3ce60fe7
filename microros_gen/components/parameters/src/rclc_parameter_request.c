/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Requests stay as they are on the wire: they are checked when they arrive, copied once, and read again when they are
 * answered. So a name may be as long as it likes, and no message of their types takes memory.
 *
 * A request that is larger than the largest arrives as the length of its list alone.
 */
#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameters.h"

#include <string.h>

parameter_requested_t rclc_parameter_request_parameter(cdr_in_t * in)
{
  parameter_requested_t requested = {.name = {"", 0}, .type = (uint8_t)RCLC_PARAMETER_NOT_SET};
  bool truth = false;
  int64_t integer = 0;
  double number = 0.0;

  requested.name = rclc_parameter_in_text(in);
  cdr_get_1(in, &requested.type, 1u, "message");
  cdr_get_bool(in, &truth, 1u, "message");
  cdr_get_8(in, &integer, 1u, "message");
  cdr_get_8(in, &number, 1u, "message");
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  requested.string = rclc_parameter_in_text(in);
#else
  (void)rclc_parameter_in_text(in);
#endif
  rclc_parameter_array_request(in, &requested);
  if (requested.type == (uint8_t)RCLC_PARAMETER_BOOL) {
    requested.value.bool_value = truth;
  } else if (requested.type == (uint8_t)RCLC_PARAMETER_DOUBLE) {
    requested.value.double_value = number;
  } else {
    requested.value.integer_value = integer;
  }
  return requested;
}

cdr_in_t rclc_parameter_request_begin(const rclc_parameter_server_t * server, cdr_fault_t * fault)
{
  const cdr_in_t in = {server->request, server->request_size, 0, server->request_swaps, false, fault};

  return in;
}

/* Whether a request arrived without the entries of its list; then notes how many these are. */
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

/* Keeps a request that was read to its end. */
static void request_keep(cdr_in_t * in, rclc_parameter_server_t * server)
{
  if (in->failed) {
    return;
  }
  if (in->size > sizeof(server->request)) {
    cdr_in_refuse(in, CDR_FAULT_CAPACITY, "message", in->size, sizeof(server->request));
    return;
  }
  (void)memcpy(server->request, in->body, in->size);
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
  uint32_t count;

  if (request_cut(in, server)) {
    return;
  }
  count = rclc_parameter_in_length(in);
  for (uint32_t i = 0; i < count && !in->failed; ++i) {
    (void)rclc_parameter_request_parameter(in);
  }
  request_keep(in, server);
}
