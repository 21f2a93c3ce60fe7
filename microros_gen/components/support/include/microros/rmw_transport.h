/* SPDX-License-Identifier: Apache-2.0 */
/* Configures a transport from the options of a session; implemented by each transport component. Internal. */
#ifndef MICROROS_RMW_TRANSPORT_H
#define MICROROS_RMW_TRANSPORT_H

#include <stdbool.h>

#include "microros/rmw_transport_params.h"
#include "microros/xrce_transport.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Fills in the arguments of xrce_transport_open: from the options, otherwise from the plan. `params` must
 * outlive the transport. Returns false, with the error set, if the address is missing.
 */
bool rmw_transport_prepare(xrce_transport_t * transport, const rmw_uxrce_transport_params_t * params);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_TRANSPORT_H */
