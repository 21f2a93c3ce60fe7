/* SPDX-License-Identifier: Apache-2.0 */
/* Every message has a fixed size: no encoder refuses one, and no text for that is linked. */
#include "microros/rmw_encode.h"

rmw_ret_t rmw_encode_refuse(const microros_message_type_t * type, const cdr_fault_t * fault)
{
  (void)type;
  (void)fault;
  return RMW_RET_ERROR;
}
