/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rclc_parameter_client.h"
#include "microros/rclc_parameter_in.h"

#include <stddef.h>
#include <string.h>

/* Returns whether a sequence of ranges has an element; the interface allows one. */
static bool describe_has_range(cdr_in_t * in)
{
  const uint32_t count = rclc_parameter_in_length(in);

  if (count > 1u) {
    cdr_in_refuse(in, CDR_FAULT_BOUND, "range", count, 1u);
  }
  return count == 1u;
}

/* In the order of rcl_interfaces/msg/ParameterDescriptor. */
static void describe_read(cdr_in_t * in, rclc_parameter_client_descriptor_t * descriptor)
{
  uint8_t type = (uint8_t)RCLC_PARAMETER_NOT_SET;

  (void)memset(descriptor, 0, sizeof(*descriptor));
  descriptor->name = rclc_parameter_client_read_text(in);
  cdr_get_1(in, &type, 1u, "type");
  if (type > (uint8_t)RCLC_PARAMETER_STRING_ARRAY) {
    cdr_in_refuse(in, CDR_FAULT_VALUE, "type", type, (uint32_t)RCLC_PARAMETER_STRING_ARRAY);
    type = (uint8_t)RCLC_PARAMETER_NOT_SET;
  }
  descriptor->type = (rclc_parameter_type_t)type;
  descriptor->description = rclc_parameter_client_read_text(in);
  descriptor->additional_constraints = rclc_parameter_client_read_text(in);
  cdr_get_bool(in, &descriptor->read_only, 1u, "read_only");
  cdr_get_bool(in, &descriptor->dynamic_typing, 1u, "dynamic_typing");
  descriptor->has_floating_point_range = describe_has_range(in);
  if (descriptor->has_floating_point_range) {
    cdr_get_8(in, &descriptor->floating_point_range.from_value, 1u, "from_value");
    cdr_get_8(in, &descriptor->floating_point_range.to_value, 1u, "to_value");
    cdr_get_8(in, &descriptor->floating_point_range.step, 1u, "step");
  }
  descriptor->has_integer_range = describe_has_range(in);
  if (descriptor->has_integer_range) {
    cdr_get_8(in, &descriptor->integer_range.from_value, 1u, "from_value");
    cdr_get_8(in, &descriptor->integer_range.to_value, 1u, "to_value");
    cdr_get_8(in, &descriptor->integer_range.step, 1u, "step");
  }
}

void rclc_parameter_client_decode_descriptors(cdr_in_t * in, void * client)
{
  cdr_in_t kept = rclc_parameter_client_keep(client, in);
  const uint32_t count = rclc_parameter_in_length(&kept);

  for (uint32_t i = 0; i < count && !kept.failed; ++i) {
    rclc_parameter_client_descriptor_t descriptor;

    describe_read(&kept, &descriptor);
  }
  rclc_parameter_client_settle(client, in, &kept, count);
}

rcl_ret_t rclc_parameter_client_describe_async(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms,
  rclc_parameter_client_callback_t callback, void * context)
{
  const rcl_ret_t result = rclc_parameter_client_check_names(client, names, count);

  return result != RCL_RET_OK
           ? result
           : rclc_parameter_client_send(
               client, (uint8_t)RCLC_PARAMETER_CLIENT_DESCRIBE, names, count, timeout_ms, callback, context);
}

rcl_ret_t rclc_parameter_client_describe(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms)
{
  const rcl_ret_t result = rclc_parameter_client_check_names(client, names, count);

  return result != RCL_RET_OK ? result
                              : rclc_parameter_client_send_and_wait(
                                  client, (uint8_t)RCLC_PARAMETER_CLIENT_DESCRIBE, names, count, timeout_ms);
}

rcl_ret_t rclc_parameter_client_descriptor(
  rclc_parameter_client_t * client, size_t index, rclc_parameter_client_descriptor_t * descriptor)
{
  cdr_fault_t fault;
  cdr_in_t in;

  if (
    descriptor == NULL || index >= rclc_parameter_client_count(client) ||
    client->call != (uint8_t)RCLC_PARAMETER_CLIENT_DESCRIBE) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client, index or descriptor");
  }
  in = rclc_parameter_client_begin(client, &fault);
  (void)rclc_parameter_in_length(&in);
  for (size_t i = 0; i <= index; ++i) {
    describe_read(&in, descriptor);
  }
  return RCL_RET_OK;
}

rcl_ret_t rclc_parameter_client_get_descriptor(
  rclc_parameter_client_t * client, const char * name, rclc_parameter_client_descriptor_t * output,
  uint32_t timeout_ms)
{
  rcl_ret_t result;

  if (output == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output");
  }
  result = rclc_parameter_client_describe(client, &name, 1u, timeout_ms);
  return result == RCL_RET_OK ? rclc_parameter_client_descriptor(client, 0u, output) : result;
}
