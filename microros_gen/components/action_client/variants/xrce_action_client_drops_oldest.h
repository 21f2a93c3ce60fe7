/* SPDX-License-Identifier: Apache-2.0 */
/* Requests that `on_full: drop_oldest` removed from the stream. Internal. */
#ifndef MICROROS_XRCE_ACTION_CLIENT_DROPS_H
#define MICROROS_XRCE_ACTION_CLIENT_DROPS_H

#include <stdint.h>

#include "microros/xrce_client.h"

/* Returns a count of them, modulo 2^32. */
static inline uint32_t xrce_action_client_drops(const xrce_client_t * client)
{
  return client->action_client_drops;
}

#endif /* MICROROS_XRCE_ACTION_CLIENT_DROPS_H */
