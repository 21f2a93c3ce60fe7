/* SPDX-License-Identifier: Apache-2.0 */
/* Why a session did not begin, where the handshake of sealed messages knows it. Internal. */
#ifndef MICROROS_RMW_INIT_REASON_H
#define MICROROS_RMW_INIT_REASON_H

#include <stdbool.h>

#include "microros/xrce_client.h"

/* Returns whether it set the error. */
bool rmw_init_reason(const xrce_client_t * client);

#endif /* MICROROS_RMW_INIT_REASON_H */
