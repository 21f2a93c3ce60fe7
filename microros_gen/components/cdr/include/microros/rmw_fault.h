/* SPDX-License-Identifier: Apache-2.0 */
/* Turns the refusal of an encoder or decoder into the error of the call. Internal to the middleware layer. */
#ifndef MICROROS_RMW_FAULT_H
#define MICROROS_RMW_FAULT_H

#include "microros/error.h"
#include "microros/message_type.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Sets `error` as the last one, with the path of the refused member of `type`: "markers[2].text"; of one above
 * a limit, with the key that the application file needs: "markers: {text: 9}". Returns RMW_RET_ERROR. */
rmw_ret_t rmw_fault_report(
  microros_error_t error, const microros_message_type_t * type, const cdr_fault_t * fault);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_FAULT_H */
