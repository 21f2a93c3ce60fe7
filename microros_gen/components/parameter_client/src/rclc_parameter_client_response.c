/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Responses and events are kept in their encoded form: checked when they arrive, copied once, and read again when the
 * application reads a value. So no decoded message takes memory, and strings and arrays are read in place.
 */
#include "microros/lock.h"
#include "microros/rclc_parameter_client.h"
#include "microros/rclc_parameter_in.h"
#include "microros/rmw_service.h"
#include "microros/xrce_read.h"

#include <stddef.h>
#include <string.h>

/* The arrays of a value in order, except the array of strings. */
enum { CLIENT_ARRAYS = 4, CLIENT_WIDEST = 8 };

cdr_in_t rclc_parameter_client_keep(rclc_parameter_client_t * client, cdr_in_t * in)
{
  const uint32_t start = in->position & ~((uint32_t)CLIENT_WIDEST - 1u);
  const uint32_t size = in->size - start;
  cdr_in_t kept = {client->message.bytes, size, in->position - start, in->swap, in->failed, in->fault};

  if (size > sizeof(client->message)) {
    cdr_in_refuse(in, CDR_FAULT_VALUE, "message", size, sizeof(client->message));
    kept.failed = true;
    return kept;
  }
  (void)memcpy(client->message.bytes, &in->body[start], size);
  client->size = size;
  client->start = kept.position;
  client->swaps = in->swap;
  in->position = in->size;
  return kept;
}

cdr_in_t rclc_parameter_client_begin(const rclc_parameter_client_t * client, cdr_fault_t * fault)
{
  cdr_in_t in = {client->message.bytes, client->size, client->start, client->swaps, false, NULL};

  (void)memset(fault, 0, sizeof(*fault));
  in.fault = fault;
  return in;
}

const char * rclc_parameter_client_read_text(cdr_in_t * in)
{
  const uint32_t length = rclc_parameter_in_length(in);
  const uint8_t * bytes = rclc_parameter_in_take(in, length, 1u);

  if (length == 0u || bytes == NULL) {
    return "";
  }
  if (bytes[length - 1u] != 0u) {
    cdr_in_refuse(in, CDR_FAULT_VALUE, "string", bytes[length - 1u], 0u);
    return "";
  }
  return (const char *)bytes;
}

/* Returns the first element of an array, and how many there are. */
static const void * read_parameter_array(cdr_in_t * in, uint32_t width, uint32_t * count)
{
  *count = cdr_in_length(in, width, "array");
  return *count != 0u ? rclc_parameter_in_take(in, *count, width) : NULL;
}

/* The elements were counted when they arrived. */
static uint32_t read_parameter_strings(rclc_parameter_client_t * client, cdr_in_t * in)
{
  const uint32_t count = rclc_parameter_in_length(in);

#if MICROROS_PARAMETER_CLIENT_STRINGS > 0u
  if (count > MICROROS_PARAMETER_CLIENT_STRINGS) {
    cdr_in_refuse(in, CDR_FAULT_CAPACITY, "string_array_value", count, MICROROS_PARAMETER_CLIENT_STRINGS);
  }
  for (uint32_t i = 0; i < count && !in->failed; ++i) {
    client->strings[i] = rclc_parameter_client_read_text(in);
  }
#else
  (void)client;
  if (count != 0u) {
    cdr_in_refuse(in, CDR_FAULT_CAPACITY, "string_array_value", count, 0u);
  }
#endif
  return count;
}

static void parameter_value_take_array(
  rclc_parameter_client_value_t * value, const void * elements, uint32_t count)
{
  value->count = count;
  switch (value->type) {
    case RCLC_PARAMETER_BYTE_ARRAY:
      value->as.byte_array_value = elements;
      break;
    case RCLC_PARAMETER_BOOL_ARRAY:
      value->as.bool_array_value = elements;
      break;
    case RCLC_PARAMETER_INT_ARRAY:
      value->as.integer_array_value = elements;
      break;
    case RCLC_PARAMETER_DOUBLE_ARRAY:
    case RCLC_PARAMETER_NOT_SET:
    case RCLC_PARAMETER_BOOL:
    case RCLC_PARAMETER_INT:
    case RCLC_PARAMETER_DOUBLE:
    case RCLC_PARAMETER_STRING:
    case RCLC_PARAMETER_STRING_ARRAY:
    default: /* only types of arrays are passed to this function */
      value->as.double_array_value = elements;
      break;
  }
}

static void parameter_value_take_scalar(
  rclc_parameter_client_value_t * value, bool truth, int64_t integer, double number, const char * text)
{
  switch (value->type) {
    case RCLC_PARAMETER_BOOL:
      value->as.bool_value = truth;
      break;
    case RCLC_PARAMETER_INT:
      value->as.integer_value = integer;
      break;
    case RCLC_PARAMETER_DOUBLE:
      value->as.double_value = number;
      break;
    case RCLC_PARAMETER_STRING:
    case RCLC_PARAMETER_NOT_SET:
    case RCLC_PARAMETER_BYTE_ARRAY:
    case RCLC_PARAMETER_BOOL_ARRAY:
    case RCLC_PARAMETER_INT_ARRAY:
    case RCLC_PARAMETER_DOUBLE_ARRAY:
    case RCLC_PARAMETER_STRING_ARRAY:
    default: /* arrays are not passed to this function */
      value->as.string_value = text;
      break;
  }
}

void rclc_parameter_client_read_value(
  rclc_parameter_client_t * client, cdr_in_t * in, rclc_parameter_client_value_t * value)
{
  static const uint8_t widths[CLIENT_ARRAYS] = {1u, 1u, 8u, 8u};
  uint8_t type = (uint8_t)RCLC_PARAMETER_NOT_SET;
  bool truth = false;
  int64_t integer = 0;
  double number = 0.0;
  const char * text;
  uint32_t strings;

  cdr_get_1(in, &type, 1u, "type");
  cdr_get_bool(in, &truth, 1u, "bool_value");
  cdr_get_8(in, &integer, 1u, "integer_value");
  cdr_get_8(in, &number, 1u, "double_value");
  text = rclc_parameter_client_read_text(in);
  value->type = (rclc_parameter_type_t)type;
  value->count = 0;
  parameter_value_take_scalar(value, truth, integer, number, text);
  for (uint32_t i = 0; i < (uint32_t)CLIENT_ARRAYS; ++i) {
    uint32_t count;
    const void * elements = read_parameter_array(in, widths[i], &count);

    if (type == (uint32_t)RCLC_PARAMETER_BYTE_ARRAY + i) {
      parameter_value_take_array(value, elements, count);
    }
  }
  strings = read_parameter_strings(client, in);
#if MICROROS_PARAMETER_CLIENT_STRINGS > 0u
  if (type == (uint8_t)RCLC_PARAMETER_STRING_ARRAY) {
    value->count = strings;
    value->as.string_array_value = client->strings;
  }
#else
  (void)strings;
#endif
}

/* Returns an element of the message for changes. */
static uint8_t * parameter_value_at(rclc_parameter_client_t * client, const void * element)
{
  return &client->message.bytes[(const uint8_t *)element - client->message.bytes];
}

static void parameter_value_turn(uint8_t * bytes, uint32_t count)
{
  for (uint32_t i = 0; i < count; ++i) {
    uint8_t * number = &bytes[(size_t)i * (size_t)CLIENT_WIDEST];

    for (uint32_t k = 0; k < (uint32_t)CLIENT_WIDEST / 2u; ++k) {
      const uint8_t other = number[CLIENT_WIDEST - 1u - k];

      number[CLIENT_WIDEST - 1u - k] = number[k];
      number[k] = other;
    }
  }
}

void rclc_parameter_client_settle_value(rclc_parameter_client_t * client, cdr_in_t * in)
{
  rclc_parameter_client_value_t value;

  rclc_parameter_client_read_value(client, in, &value);
  if (in->failed || value.count == 0u) {
    return;
  }
  if (value.type == RCLC_PARAMETER_BOOL_ARRAY) {
    uint8_t * truths = parameter_value_at(client, value.as.bool_array_value);

    for (size_t i = 0; i < value.count; ++i) {
      truths[i] = truths[i] != 0u ? 1u : 0u;
    }
  } else if (in->swap && value.type == RCLC_PARAMETER_INT_ARRAY) {
    parameter_value_turn(parameter_value_at(client, value.as.integer_array_value), (uint32_t)value.count);
  } else if (in->swap && value.type == RCLC_PARAMETER_DOUBLE_ARRAY) {
    parameter_value_turn(parameter_value_at(client, value.as.double_array_value), (uint32_t)value.count);
  } else {
    /* as it is */
  }
}

void rclc_parameter_client_settle(
  rclc_parameter_client_t * client, cdr_in_t * in, const cdr_in_t * kept, uint32_t count)
{
  if (kept->failed) {
    client->exceeds = kept->fault->kind == CDR_FAULT_CAPACITY ? (uint16_t)kept->fault->found : 0u;
    client->size = 0;
    in->failed = true;
  }
  client->count = in->failed ? 0u : count;
}

void rclc_parameter_client_decode_values(cdr_in_t * in, void * client)
{
  cdr_in_t kept = rclc_parameter_client_keep(client, in);
  const uint32_t count = rclc_parameter_in_length(&kept);

  for (uint32_t i = 0; i < count && !kept.failed; ++i) {
    rclc_parameter_client_settle_value(client, &kept);
  }
  rclc_parameter_client_settle(client, in, &kept, count);
}

static void parameter_response_pass_result(cdr_in_t * in)
{
  bool successful;

  cdr_get_bool(in, &successful, 1u, "successful");
  (void)rclc_parameter_client_read_text(in);
}

void rclc_parameter_client_decode_results(cdr_in_t * in, void * client)
{
  cdr_in_t kept = rclc_parameter_client_keep(client, in);
  const uint32_t count = rclc_parameter_in_length(&kept);

  for (uint32_t i = 0; i < count && !kept.failed; ++i) {
    parameter_response_pass_result(&kept);
  }
  rclc_parameter_client_settle(client, in, &kept, count);
}

void rclc_parameter_client_decode_result(cdr_in_t * in, void * client)
{
  cdr_in_t kept = rclc_parameter_client_keep(client, in);

  parameter_response_pass_result(&kept);
  rclc_parameter_client_settle(client, in, &kept, 1u);
}

void rclc_parameter_client_decode_names(cdr_in_t * in, void * client)
{
  cdr_in_t kept = rclc_parameter_client_keep(client, in);
  const uint32_t count = rclc_parameter_in_length(&kept);

  for (uint32_t i = 0; i < count && !kept.failed; ++i) {
    (void)rclc_parameter_client_read_text(&kept);
  }
  rclc_parameter_client_settle(client, in, &kept, count);
}

uint16_t rclc_parameter_client_take_large(const rclc_parameter_client_t * client, uint16_t * fits)
{
  const rmw_client_t * requester = client->services[client->call].impl;
  uint16_t large;

  microros_lock();
  large = xrce_read_large(requester->data, fits);
  microros_unlock();
  return large;
}
