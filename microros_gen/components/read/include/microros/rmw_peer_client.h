/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Clients that call a server of another board without the agent: none, unless a component replaces this header. Called
 * with the lock held. Internal. */
#ifndef MICROROS_RMW_PEER_CLIENT_H
#define MICROROS_RMW_PEER_CLIENT_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"

/* Returns whether a client calls a server of another board; *is_connected: whether that board has answered. */
static inline bool rmw_peer_server(const xrce_endpoint_t * client, bool * is_connected)
{
  (void)client;
  (void)is_connected;
  return false;
}

static inline rmw_ret_t rmw_peer_send_request(
  const xrce_endpoint_t * endpoint, const microros_message_type_t * sent, const void * ros_request,
  uint16_t * number)
{
  (void)endpoint;
  (void)sent;
  (void)ros_request;
  (void)number;
  return RMW_RET_ERROR;
}

#endif /* MICROROS_RMW_PEER_CLIENT_H */
