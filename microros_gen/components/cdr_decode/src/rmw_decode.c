/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_decode.h"

#include "microros/cdr_decode.h"
#include "microros/rmw_fault.h"

#include <stddef.h>

static bool is_little_endian_here(void)
{
  const uint16_t one = 1u;

  return *(const uint8_t *)&one != 0u;
}

rmw_ret_t rmw_decode_refuse(const microros_message_type_t * type, const cdr_fault_t * fault)
{
  microros_error_t error = microros_error_field_capacity;

  if (fault->kind == CDR_FAULT_END) {
    error = microros_error_body_end;
  } else if (fault->kind == CDR_FAULT_VALUE) {
    error = microros_error_value;
  } else if (fault->kind == CDR_FAULT_BOUND) {
    error = microros_error_field_bound;
  } else {
    /* above a capacity */
  }
  return rmw_fault_report(error, type, fault);
}

rmw_ret_t rmw_decode(
  const microros_message_type_t * type, const uint8_t * body, uint32_t size, bool big_endian, void * message)
{
  cdr_fault_t fault; /* set if the body is refused */

  if (type->decode == NULL) {
    return microros_error_named(RMW_RET_UNSUPPORTED, microros_error_not_received, type->dds_type_name);
  }
  if (!cdr_decode(type, body, size, big_endian == is_little_endian_here(), message, &fault)) {
    return rmw_decode_refuse(type, &fault);
  }
  return RMW_RET_OK;
}
