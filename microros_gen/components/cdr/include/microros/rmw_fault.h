/* SPDX-License-Identifier: Apache-2.0 */
/* From the refusal of an encoder or decoder to the error of the call. Internal to the middleware layer. */
#ifndef MICROROS_RMW_FAULT_H
#define MICROROS_RMW_FAULT_H

#include "microros/error.h"
#include "microros/message_type.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Makes `error` the last one, with the member of `type` that was refused: "markers[2].text"; RMW_RET_ERROR. */
rmw_ret_t rmw_fault_report(
  microros_error_t error, const microros_message_type_t * type, const cdr_fault_t * fault);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_FAULT_H */
