/* SPDX-License-Identifier: Apache-2.0 */
/* Some messages contain a string or sequence. */
#include "microros/rmw_encode.h"

#include "microros/rmw_fault.h"

rmw_ret_t rmw_encode_refuse(const microros_message_type_t * type, const cdr_fault_t * fault)
{
  microros_error_t error = microros_error_field;

  if (fault->kind == CDR_FAULT_BOUND) {
    error = microros_error_field_bound;
  } else if (fault->kind == CDR_FAULT_DATA) {
    error = microros_error_field_data;
  } else {
    /* above a limit of the application file */
  }
  return rmw_fault_report(error, type, fault);
}
