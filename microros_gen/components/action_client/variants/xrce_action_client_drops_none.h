/* SPDX-License-Identifier: Apache-2.0 */
/* Requests that were removed from the stream: a full stream takes no further ones. Internal. */
#ifndef MICROROS_XRCE_ACTION_CLIENT_DROPS_H
#define MICROROS_XRCE_ACTION_CLIENT_DROPS_H

#include <stdint.h>

#include "microros/xrce_client.h"

static inline uint32_t xrce_action_client_drops(const xrce_client_t * client)
{
  (void)client;
  return 0;
}

#endif /* MICROROS_XRCE_ACTION_CLIENT_DROPS_H */
