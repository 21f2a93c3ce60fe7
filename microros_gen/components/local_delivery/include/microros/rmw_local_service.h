/* SPDX-License-Identifier: Apache-2.0 */
/* Requests and replies of the same image. Called with the lock held. Internal. */
#ifndef MICROROS_RMW_LOCAL_SERVICE_H
#define MICROROS_RMW_LOCAL_SERVICE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_read.h"
#include "rmw/ret_types.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The number of a request among those of all clients, as on the wire, and its sequence number. */
typedef struct rmw_local_number_t {
  int64_t sequence;
  uint16_t request;
} rmw_local_number_t;

/* Returns whether a request or reply of the image waits for a service or client. */
bool rmw_local_waits(const xrce_endpoint_t * endpoint);

/*
 * Copies the oldest request to the caller's and removes it. `request` gets its identity, of `sample` only the time of the
 * send call is set; *result: RMW_RET_ERROR, with a text, if the caller's message has too little memory. Returns false, having
 * done nothing, if the next request is one of the agent. */
bool rmw_local_take_request(
  const xrce_endpoint_t * service, rmw_request_id_t * request, xrce_sample_t * sample, void * ros_request,
  rmw_ret_t * result);

/* Returns whether an identity is that of a request of the image. */
bool rmw_local_is_request(const rmw_request_id_t * request);

/*
 * Copies the response to such a request, of type `sent`, to the queue of its client; it stays the caller's. A client that was
 * closed meanwhile gets none. RMW_RET_ERROR, with a text: it is above its limits. */
rmw_ret_t rmw_local_respond(
  const xrce_endpoint_t * service, const microros_message_type_t * sent, const rmw_request_id_t * request,
  const void * ros_response);

/*
 * Copies a request of a client that calls a server of the image, of type `sent`, to the queue of the server; it stays the
 * caller's. A server that is not open gets none. RMW_RET_ERROR, with a text: it is above its limits, or the queue is full. */
rmw_ret_t rmw_local_send_request(
  const xrce_endpoint_t * client, const microros_message_type_t * sent, const rmw_local_number_t * number,
  const void * ros_request);

/* Returns in *number to which request the oldest reply is; false: none waits. */
bool rmw_local_find_reply(const xrce_endpoint_t * client, uint16_t * number);

/* Copies the oldest reply, which exists, to the caller's and removes it. Of `sample` only the time is set. */
rmw_ret_t rmw_local_take_reply(const xrce_endpoint_t * client, xrce_sample_t * sample, void * ros_response);

/* Removes and counts the oldest reply, which exists. */
void rmw_local_discard_reply(const xrce_endpoint_t * client);

/* Returns whether a client calls a server of the image; *is_open: whether that is open. */
bool rmw_local_server(const xrce_endpoint_t * client, bool * is_open);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_LOCAL_SERVICE_H */
