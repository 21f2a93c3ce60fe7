/* SPDX-License-Identifier: Apache-2.0 */
/* Why a session did not begin, where the transport knows more. A component replaces this header. Internal. */
#ifndef MICROROS_RMW_INIT_REASON_H
#define MICROROS_RMW_INIT_REASON_H

#include <stdbool.h>

#include "microros/xrce_client.h"

/* Returns whether it set the error. */
static inline bool rmw_init_reason(const xrce_client_t * client)
{
  (void)client;
  return false;
}

#endif /* MICROROS_RMW_INIT_REASON_H */
