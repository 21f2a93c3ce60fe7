/* SPDX-License-Identifier: Apache-2.0 */
/* From the options of a session to its transport; each transport component implements it. Internal. */
#ifndef MICROROS_RMW_TRANSPORT_H
#define MICROROS_RMW_TRANSPORT_H

#include <stdbool.h>

#include "microros/rmw_transport_params.h"
#include "microros/xrce_transport.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Fills in what xrce_transport_open needs: what the options say, or else the plan. `params` must live as long as
 * the transport. False, and the error is set: there is nothing to open.
 */
bool rmw_transport_prepare(xrce_transport_t * transport, const rmw_uxrce_transport_params_t * params);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_TRANSPORT_H */
