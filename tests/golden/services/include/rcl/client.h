/* SPDX-License-Identifier: Apache-2.0 */
/* Service clients. */
#ifndef MICROROS_RCL_CLIENT_H
#define MICROROS_RCL_CLIENT_H

#include <stdbool.h>
#include <stdint.h>

#include "rcl/macros.h"
#include "rcl/node.h"
#include "rcl/visibility_control.h"
#include "rmw/qos_profiles.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_client_s rcl_client_impl_t;

typedef struct rcl_client_s {
  rcl_client_impl_t * impl; /* owned by the library; NULL: not initialized */
} rcl_client_t;

typedef struct rcl_client_options_s {
  rmw_qos_profile_t qos;
  rcl_allocator_t allocator;
} rcl_client_options_t;

rcl_client_t rcl_get_zero_initialized_client(void);

/*
 * Waits for the agent, at most MICROROS_CREATE_TIMEOUT_MS; not for a server, since XRCE does not report
 * whether one exists. With `nodes:` in the application file the client must be declared there; otherwise
 * it uses one of `pools: {clients: N}`. QoS and errors as for rcl_service_init.
 */
rcl_ret_t rcl_client_init(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rcl_client_options_t * options);

/*
 * Frees the client's place and its requests at once; waits for the agent, at most
 * MICROROS_CLOSE_TIMEOUT_MS. */
rcl_ret_t rcl_client_fini(rcl_client_t * client, rcl_node_t * node);

/* Returns options with rmw_qos_profile_services_default. */
rcl_client_options_t rcl_client_get_default_options(void);

/*
 * Encodes the request into the reliable stream and passes it to the transport; does not wait, unless
 * `on_full` is block. Returns its sequence number: 1, 2, 3, … At most `queue:` requests can be
 * outstanding; a further one replaces the oldest, whose reply is then discarded, and is counted
 * (rmw_uros_get_client_statistics), so that a client continues after the server was absent. RCL_RET_ERROR,
 * with a text: a field above its limit, no room, or no session.
 */
rcl_ret_t rcl_send_request(const rcl_client_t * client, const void * ros_request, int64_t * sequence_number);

/*
 * Receives without waiting, and decodes the oldest reply into the storage of the message; the header gets
 * the sequence number of its request. Replies arrive in the order in which the server sends them.
 * RCL_RET_CLIENT_TAKE_FAILED: no reply was received. RCL_RET_ERROR, with a text: a reply was discarded, as
 * described for rcl_take_request_with_info; or, once after a session was lost, the number of outstanding
 * requests, whose replies may not arrive. The next call returns the next reply.
 */
rcl_ret_t rcl_take_response_with_info(
  const rcl_client_t * client, rmw_service_info_t * request_header, void * ros_response);

/* As rcl_take_response_with_info, without times. */
rcl_ret_t rcl_take_response(
  const rcl_client_t * client, rmw_request_id_t * request_header, void * ros_response);

/* Returns the fully qualified name, which belongs to the client; NULL for an invalid client. */
const char * rcl_client_get_service_name(const rcl_client_t * client);

/* Return the requested QoS with defaults resolved; NULL for an invalid client. The agent uses its own QoS
 * towards ROS 2. Belongs to the client. */
const rmw_qos_profile_t * rcl_client_request_publisher_get_actual_qos(const rcl_client_t * client);
const rmw_qos_profile_t * rcl_client_response_subscription_get_actual_qos(const rcl_client_t * client);

/* Same as options: the QoS is the actual one, the allocator the default one, since none is called. */
const rcl_client_options_t * rcl_client_get_options(const rcl_client_t * client);

rmw_client_t * rcl_client_get_rmw_handle(const rcl_client_t * client);

bool rcl_client_is_valid(const rcl_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLIENT_H */
