/* SPDX-License-Identifier: Apache-2.0 */
/* Agent discovery for the middleware layer; internal. */
#ifndef MICROROS_RMW_DISCOVERY_H
#define MICROROS_RMW_DISCOVERY_H

#include <stdint.h>

#include "microros/rmw_transport_params.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes the address of the first agent that answers to `params`. RMW_RET_TIMEOUT, with a text, if no
 * agent answered within `timeout_ms` and `params` names none. The caller holds the lock, which is released
 * while this function waits. */
rmw_ret_t rmw_discovery_find(rmw_uxrce_transport_params_t * params, uint32_t timeout_ms);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_DISCOVERY_H */
