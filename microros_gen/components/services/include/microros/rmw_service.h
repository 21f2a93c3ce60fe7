/* SPDX-License-Identifier: Apache-2.0 */
/* Services and clients of the middleware layer, named as their objects are: repliers and requesters. Internal. */
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
 * Takes the place of a service, or of a client, and waits for its object. RMW_RET_OK: the handle is set and belongs to the
 * library; RMW_RET_UNSUPPORTED, RMW_RET_TIMEOUT, RMW_RET_ERROR with a text otherwise. `name` is valid and not expanded.
 */
rmw_ret_t rmw_replier_open(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, const char * name,
  const rmw_qos_profile_t * qos, rmw_service_t ** service);
rmw_ret_t rmw_requester_open(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, const char * name,
  const rmw_qos_profile_t * qos, rmw_client_t ** client);

/* Gives the place back. */
void rmw_replier_close(rmw_service_t * service);
void rmw_requester_close(rmw_client_t * client);

bool rmw_replier_is_open(const rmw_service_t * service);
bool rmw_requester_is_open(const rmw_client_t * client);

/* --- of an open one, without receiving: who waits for several has received before --- */

/* Whether the take below has a message, or an error to tell; of a service also, whether the reply would find room now. So
 * a request waits until it can be answered. */
bool rmw_replier_is_ready(const rmw_service_t * service);
bool rmw_requester_is_ready(const rmw_client_t * client);

/* Decodes the oldest request; *taken is false when there is none, while its reply would find no room, and when the result is
 * an error. `info` gets whose it is. */
rmw_ret_t rmw_replier_take(
  const rmw_service_t * service, rmw_service_info_t * info, void * ros_request, bool * taken);

/* Decodes the oldest reply to a request that has none yet; `info` gets the request's sequence number. Otherwise the
 * same. */
rmw_ret_t rmw_requester_take(
  const rmw_client_t * client, rmw_service_info_t * info, void * ros_response, bool * taken);

/* --- these pump --- */

/* Receives what has come. */
void rmw_replier_pump(const rmw_service_t * service);
void rmw_requester_pump(const rmw_client_t * client);

/* --- for the executor, which answers when the callback returns --- */

/* As rmw_replier_take; a slot of the reliable stream is kept back for the reply, until one of the two below. */
rmw_ret_t rmw_replier_begin(
  const rmw_service_t * service, rmw_service_info_t * info, void * ros_request, bool * taken);

/* As rmw_replier_respond, with the slot that was kept back. */
rmw_ret_t rmw_replier_end(
  const rmw_service_t * service, const rmw_request_id_t * request, const void * ros_response);

/* There is no reply: the service was ended meanwhile. */
void rmw_replier_give_up(void);

/* Encodes a reply into the reliable stream. RMW_RET_ERROR, with a text: a field above its limit, no room, no session. */
rmw_ret_t rmw_replier_respond(
  const rmw_service_t * service, const rmw_request_id_t * request, const void * ros_response);

/* The same for a request; gives its sequence number: 1, 2, 3, … */
rmw_ret_t rmw_requester_send(
  const rmw_client_t * client, const void * ros_request, int64_t * sequence_number);

/* --- storage: a message of which no string and no sequence has a buffer gets that of its declaration --- */

/* Either may be NULL. */
void rmw_replier_bind(const rmw_service_t * service, void * ros_request, void * ros_response);
void rmw_requester_bind(const rmw_client_t * client, void * ros_response);

/* --- for both kinds --- */

/* Takes a place of `section` for the endpoint of a service, whose client, type and participant are filled in. */
rmw_ret_t rmw_service_open(
  xrce_endpoint_t * wanted, const xrce_service_t * service, const rmw_section_t * section,
  const rmw_node_t * node, const char * name, const rmw_qos_profile_t * qos);

/* Returns RMW_RET_OK, or RMW_RET_ERROR with the text for what became of a message. */
rmw_ret_t rmw_service_report(
  const xrce_endpoint_t * endpoint, xrce_write_t outcome, const cdr_fault_t * fault);

/* Says when a sample came. */
void rmw_service_describe(const xrce_sample_t * sample, rmw_service_info_t * info);

/* Decodes what is behind the first `head` bytes of the oldest sample, and pops it. */
rmw_ret_t rmw_service_decode(
  const xrce_endpoint_t * endpoint, const xrce_sample_t * sample, uint16_t head, void * message);

/* Returns the type of what the endpoint sends, under the limits of its declaration; `of_handle` where it has none. */
const microros_message_type_t * rmw_service_sent(uint16_t index, const microros_message_type_t * of_handle);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_SERVICE_H */
