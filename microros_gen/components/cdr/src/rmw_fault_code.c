/* SPDX-License-Identifier: Apache-2.0 */
/* errors: code. */
#include "microros/rmw_fault.h"

rmw_ret_t rmw_fault_report(
  microros_error_t error, const microros_message_type_t * type, const cdr_fault_t * fault)
{
  (void)type;
  (void)fault;
  return microros_error_code(RMW_RET_ERROR, error);
}
