/* SPDX-License-Identifier: Apache-2.0 */
/* Every message has a fixed size: no encoder refuses one, and no text for that is linked. Internal to the middleware layer. */
#ifndef MICROROS_RMW_ENCODE_H
#define MICROROS_RMW_ENCODE_H

#include "microros/message_type.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* For a message that the encoder of `type` refused, which none does. */
static inline rmw_ret_t rmw_encode_refuse(const microros_message_type_t * type, const cdr_fault_t * fault)
{
  (void)type;
  (void)fault;
  return RMW_RET_ERROR;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_ENCODE_H */
