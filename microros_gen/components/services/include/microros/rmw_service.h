/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Services and clients of the middleware layer, named after their XRCE objects: repliers and requesters.
 * Internal. */
#ifndef MICROROS_RMW_SERVICE_H
#define MICROROS_RMW_SERVICE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/rmw_receiver.h"
#include "microros/xrce_read.h"
#include "microros/xrce_services.h"
#include "rmw/types.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Take a place for a service or client and wait for its object. RMW_RET_OK: the handle is set and belongs
 * to the library; otherwise RMW_RET_UNSUPPORTED, RMW_RET_TIMEOUT or RMW_RET_ERROR with a text. `name` is
 * valid and not expanded.
 */
rmw_ret_t rmw_replier_open(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, const char * name,
  const rmw_qos_profile_t * qos, rmw_service_t ** service);
rmw_ret_t rmw_requester_open(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, const char * name,
  const rmw_qos_profile_t * qos, rmw_client_t ** client);

/* Release the place. */
void rmw_replier_close(rmw_service_t * service);
void rmw_requester_close(rmw_client_t * client);

bool rmw_replier_is_open(const rmw_service_t * service);
bool rmw_requester_is_open(const rmw_client_t * client);

/* --- for an open handle, without receiving: a caller that waits for several has already received --- */

/* Return whether the take functions below have a message or an error to report; for a service also,
 * whether the reply has room now. So a request waits until it can be answered. */
bool rmw_replier_is_ready(const rmw_service_t * service);
bool rmw_requester_is_ready(const rmw_client_t * client);

/* Decodes the oldest request. *taken is false if the queue is empty, if its reply would have no room, and
 * on error. `info` gets the identity of the request. */
rmw_ret_t rmw_replier_take(
  const rmw_service_t * service, rmw_service_info_t * info, void * ros_request, bool * taken);

/* Decodes the oldest reply to an unanswered request; `info` gets the request's sequence number. Otherwise
 * the same. */
rmw_ret_t rmw_requester_take(
  const rmw_client_t * client, rmw_service_info_t * info, void * ros_response, bool * taken);

/* --- these pump --- */

/* Receive without waiting. */
void rmw_replier_pump(const rmw_service_t * service);
void rmw_requester_pump(const rmw_client_t * client);

/* --- for the executor, which replies when the callback returns --- */

/*
 * As rmw_replier_take, which also gives times, and reserves a slot of the reliable stream for the reply until one
 * of the two functions below is called. */
rmw_ret_t rmw_replier_begin(
  const rmw_service_t * service, rmw_request_id_t * request, void * ros_request, bool * taken);

/* As rmw_replier_respond, with the reserved slot. */
rmw_ret_t rmw_replier_end(
  const rmw_service_t * service, const rmw_request_id_t * request, const void * ros_response);

/* Cancels the reply: the service was finalized meanwhile. */
void rmw_replier_abandon(void);

/*
 * Encodes a reply into the reliable stream. RMW_RET_ERROR, with a text: a field above its limit, no room,
 * no session. */
rmw_ret_t rmw_replier_respond(
  const rmw_service_t * service, const rmw_request_id_t * request, const void * ros_response);

/* Same for a request; returns its sequence number: 1, 2, 3, … */
rmw_ret_t rmw_requester_send(
  const rmw_client_t * client, const void * ros_request, int64_t * sequence_number);

/* --- storage: a message without any buffer for strings and sequences gets that of its declaration --- */

/* Either message may be NULL. A service that is not open is left alone. */
void rmw_replier_bind(const rmw_service_t * service, void * ros_request, void * ros_response);
void rmw_requester_bind(const rmw_client_t * client, void * ros_response);

/* --- for both kinds --- */

/*
 * Takes a place of `section` for the endpoint of a service, whose client, type and participant are filled
 * in. */
rmw_ret_t rmw_service_open(
  xrce_endpoint_t * wanted, const xrce_service_t * service, const rmw_section_t * section,
  const rmw_node_t * node, const char * name, const rmw_qos_profile_t * qos);

/* Returns RMW_RET_OK, or RMW_RET_ERROR with the text for the outcome of a write. */
rmw_ret_t rmw_service_report(
  const xrce_endpoint_t * endpoint, xrce_write_t outcome, const cdr_fault_t * fault);

/* Fills in the time at which a sample arrived. */
void rmw_service_describe(const xrce_sample_t * sample, rmw_service_info_t * info);

/* Decodes the oldest sample from byte `head` on, and removes it. */
rmw_ret_t rmw_service_decode(
  const xrce_endpoint_t * endpoint, const xrce_sample_t * sample, uint16_t head, void * message);

/*
 * Returns the type that the endpoint sends, with the limits of its declaration; `of_handle` if it has
 * none. */
const microros_message_type_t * rmw_service_sent(uint16_t index, const microros_message_type_t * of_handle);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_SERVICE_H */
