/* SPDX-License-Identifier: Apache-2.0 */
/* Clients that call a server of another board without the agent. Called with the lock held. Internal. */
#ifndef MICROROS_RMW_PEER_CLIENT_H
#define MICROROS_RMW_PEER_CLIENT_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether a client calls a server of another board; *is_connected: whether that board has answered. */
bool rmw_peer_server(const xrce_endpoint_t * client, bool * is_connected);

/*
 * Sends a request of type `sent` to the server of such a client; *number is that of XRCE. RMW_RET_ERROR, with a text:
 * it is above its limits, the other board has not answered yet, or the link has no room. */
rmw_ret_t rmw_peer_send_request(
  const xrce_endpoint_t * endpoint, const microros_message_type_t * sent, const void * ros_request,
  uint16_t * number);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PEER_CLIENT_H */
