/* SPDX-License-Identifier: Apache-2.0 */
/* Service servers. */
#ifndef MICROROS_RCL_SERVICE_H
#define MICROROS_RCL_SERVICE_H

#include <stdbool.h>

#include "rcl/macros.h"
#include "rcl/node.h"
#include "rcl/visibility_control.h"
#include "rmw/qos_profiles.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_service_s rcl_service_impl_t;

typedef struct rcl_service_s {
  rcl_service_impl_t * impl; /* owned by the library; NULL: not initialized */
} rcl_service_t;

typedef struct rcl_service_options_s {
  rmw_qos_profile_t qos;
  rcl_allocator_t allocator;
} rcl_service_options_t;

rcl_service_t rcl_get_zero_initialized_service(void);

/*
 * Waits for the agent, at most MICROROS_CREATE_TIMEOUT_MS. With `nodes:` in the application file the
 * service must be declared there; otherwise it uses one of `pools: {services: N}`. Any function of the
 * library receives requests into the queue, up to `queue:`; further ones wait at the agent. A service
 * continues automatically after a lost session. XRCE carries no QoS of services: requests and replies are
 * reliable between client and agent, which uses its own QoS towards ROS 2. RCL_RET_SERVICE_NAME_INVALID
 * for a name that ROS 2 refuses, RCL_RET_UNSUPPORTED for a QoS that XRCE cannot carry, RCL_RET_TIMEOUT,
 * otherwise RCL_RET_ERROR with a text.
 */
rcl_ret_t rcl_service_init(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rcl_service_options_t * options);

/* Frees the service's place and its queue at once; waits for the agent, at most MICROROS_CLOSE_TIMEOUT_MS. */
rcl_ret_t rcl_service_fini(rcl_service_t * service, rcl_node_t * node);

/* Returns options with rmw_qos_profile_services_default. */
rcl_service_options_t rcl_service_get_default_options(void);

/*
 * Receives without waiting, and decodes the oldest request into the storage of the message; the header
 * identifies the request and is passed back with the reply. Several requests may be taken before the first
 * is answered, in any order; the library stores nothing about them. RCL_RET_SERVICE_TAKE_FAILED: no
 * request was received, or the stream is full and a reply would be refused now: the request waits.
 * RCL_RET_ERROR, with a text: a request was discarded because it exceeds the service's limits or a
 * capacity of the message, or is not of its type. The next call returns the next request.
 */
rcl_ret_t rcl_take_request_with_info(
  const rcl_service_t * service, rmw_service_info_t * request_header, void * ros_request);

/* As rcl_take_request_with_info, without times. */
rcl_ret_t rcl_take_request(
  const rcl_service_t * service, rmw_request_id_t * request_header, void * ros_request);

/* Encodes the reply into the reliable stream and passes it to the transport; does not wait, unless
 * `on_full` is block. RCL_RET_ERROR, with a text: a field above its limit, no room (other messages have
 * filled the stream since the request was taken: send again later with the same header), or no session. */
rcl_ret_t rcl_send_response(
  const rcl_service_t * service, rmw_request_id_t * response_header, void * ros_response);

/* Returns the fully qualified name, which belongs to the service; NULL for an invalid service. */
const char * rcl_service_get_service_name(const rcl_service_t * service);

/* Return the requested QoS with defaults resolved; NULL for an invalid service. The agent uses its own QoS
 * towards ROS 2. Belongs to the service. */
const rmw_qos_profile_t * rcl_service_request_subscription_get_actual_qos(const rcl_service_t * service);
const rmw_qos_profile_t * rcl_service_response_publisher_get_actual_qos(const rcl_service_t * service);

/* Same as options: the QoS is the actual one, the allocator the default one, since none is called. */
const rcl_service_options_t * rcl_service_get_options(const rcl_service_t * service);

rmw_service_t * rcl_service_get_rmw_handle(const rcl_service_t * service);

bool rcl_service_is_valid(const rcl_service_t * service);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_SERVICE_H */
