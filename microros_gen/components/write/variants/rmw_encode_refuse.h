/* SPDX-License-Identifier: Apache-2.0 */
/* Error texts for refused messages of the application. Internal to the middleware layer. */
#ifndef MICROROS_RMW_ENCODE_H
#define MICROROS_RMW_ENCODE_H

#include "microros/message_type.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sets the text for a message that the encoder of `type` refused; returns RMW_RET_ERROR. */
rmw_ret_t rmw_encode_refuse(const microros_message_type_t * type, const cdr_fault_t * fault);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_ENCODE_H */
