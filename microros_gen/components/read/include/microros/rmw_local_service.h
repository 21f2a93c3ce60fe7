/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Requests and replies of the same image: none, unless a component replaces this header. Called with the lock held.
 * Internal.
 */
#ifndef MICROROS_RMW_LOCAL_SERVICE_H
#define MICROROS_RMW_LOCAL_SERVICE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_read.h"
#include "rmw/ret_types.h"
#include "rmw/types.h"

/* The number of a request among those of all clients, as on the wire, and its sequence number. */
typedef struct rmw_local_number_t {
  int64_t sequence;
  uint16_t request;
} rmw_local_number_t;

/* Returns whether a request or reply of the image waits for a service or client. */
static inline bool rmw_local_waits(const xrce_endpoint_t * endpoint)
{
  (void)endpoint;
  return false;
}

/* Returns false, having done nothing, if the next request is one of the agent. */

static inline bool rmw_local_take_request(
  const xrce_endpoint_t * service, rmw_request_id_t * request, xrce_sample_t * sample, void * ros_request,
  rmw_ret_t * result)
{
  (void)service;
  (void)request;
  (void)sample;
  (void)ros_request;
  (void)result;
  return false;
}

/* Returns whether an identity is that of a request of the image. */
static inline bool rmw_local_is_request(const rmw_request_id_t * request)
{
  (void)request;
  return false;
}

static inline rmw_ret_t rmw_local_respond(
  const xrce_endpoint_t * service, const microros_message_type_t * sent, const rmw_request_id_t * request,
  const void * ros_response)
{
  (void)service;
  (void)sent;
  (void)request;
  (void)ros_response;
  return RMW_RET_ERROR;
}

static inline rmw_ret_t rmw_local_send_request(
  const xrce_endpoint_t * client, const microros_message_type_t * sent, const rmw_local_number_t * number,
  const void * ros_request)
{
  (void)client;
  (void)sent;
  (void)number;
  (void)ros_request;
  return RMW_RET_ERROR;
}

static inline bool rmw_local_find_reply(const xrce_endpoint_t * client, uint16_t * number)
{
  (void)client;
  (void)number;
  return false;
}

static inline rmw_ret_t rmw_local_take_reply(
  const xrce_endpoint_t * client, xrce_sample_t * sample, void * ros_response)
{
  (void)client;
  (void)sample;
  (void)ros_response;
  return RMW_RET_ERROR;
}

static inline void rmw_local_discard_reply(const xrce_endpoint_t * client)
{
  (void)client;
}

/* Returns whether a client calls a server of the image; *is_open: whether that is open. */
static inline bool rmw_local_server(const xrce_endpoint_t * client, bool * is_open)
{
  (void)client;
  (void)is_open;
  return false;
}

#endif /* MICROROS_RMW_LOCAL_SERVICE_H */
