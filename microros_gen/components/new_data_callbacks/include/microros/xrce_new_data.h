/* SPDX-License-Identifier: Apache-2.0 */
/* What arrives for endpoints with a callback; internal. */
#ifndef MICROROS_XRCE_NEW_DATA_H
#define MICROROS_XRCE_NEW_DATA_H

#include <stdint.h>

#include "microros/xrce_client.h"
#include "rmw/event_callback_type.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sets the callback of a receiving endpoint and calls it if samples wait already. NULL: none. */
void xrce_new_data_set(
  const xrce_endpoint_t * endpoint, rmw_event_callback_t callback, const void * user_data);

/* Removes the callback of the endpoint's former owner. */
void xrce_new_data_clear(const xrce_endpoint_t * endpoint);

/* Called before and after a message from the agent is handled. */
void xrce_new_data_before(const xrce_client_t * client);
void xrce_new_data_after(const xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_NEW_DATA_H */
