/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Requests of other boards that reach a service without the agent: none, unless a component replaces this header. Called
 * with the lock held, but for rmw_peer_abandon. Internal. */
#ifndef MICROROS_RMW_PEER_SERVICE_H
#define MICROROS_RMW_PEER_SERVICE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"
#include "rmw/types.h"

/* Returns whether the oldest request is one of another board; *has_room: whether it can be answered now. */
static inline bool rmw_peer_has_room(const xrce_endpoint_t * service, bool * has_room)
{
  (void)service;
  (void)has_room;
  return false;
}

/* Returns whether an identity is that of a request of another board. */
static inline bool rmw_peer_is_request(const rmw_request_id_t * request)
{
  (void)request;
  return false;
}

/* Keeps room for the reply to such a request. Returns false, having done nothing, for another one. */
static inline bool rmw_peer_keep_room(const rmw_request_id_t * request)
{
  (void)request;
  return false;
}

/* Gives that room back; the same. */
static inline bool rmw_peer_free_room(const rmw_request_id_t * request)
{
  (void)request;
  return false;
}

/* Same, without the lock. */
static inline bool rmw_peer_abandon(const rmw_request_id_t * request)
{
  (void)request;
  return false;
}

static inline rmw_ret_t rmw_peer_respond(
  const xrce_endpoint_t * service, const microros_message_type_t * sent, const uint8_t * identity,
  const void * ros_response)
{
  (void)service;
  (void)sent;
  (void)identity;
  (void)ros_response;
  return RMW_RET_ERROR;
}

#endif /* MICROROS_RMW_PEER_SERVICE_H */
