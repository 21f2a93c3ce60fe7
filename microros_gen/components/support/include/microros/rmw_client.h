/* SPDX-License-Identifier: Apache-2.0 */
/* The client of a context: internal to the middleware layer. */
#ifndef MICROROS_RMW_CLIENT_H
#define MICROROS_RMW_CLIENT_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const char * const rmw_implementation_identifier;

/* Returns the only client of this process, open or not. */
xrce_client_t * rmw_client_instance(void);

/* Returns the number of this client at its agent. */
uint32_t rmw_client_key(void);

/* Returns how many sessions were opened after a loss: another number in each session. */
uint32_t rmw_client_reconnects(void);

/* Waits for at most `timeout_ms` until everything of before the call is acknowledged. */
bool rmw_client_flush(xrce_client_t * client, uint32_t timeout_ms);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_CLIENT_H */
