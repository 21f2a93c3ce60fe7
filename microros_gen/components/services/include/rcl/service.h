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
  rcl_service_impl_t * impl; /* the library's; NULL: not initialized */
} rcl_service_t;

typedef struct rcl_service_options_s {
  rmw_qos_profile_t qos;
  rcl_allocator_t allocator;
} rcl_service_options_t;

rcl_service_t rcl_get_zero_initialized_service(void);

/*
 * Waits for the agent, at most MICROROS_CREATE_TIMEOUT_MS. With `nodes:` in the application file the service must be
 * declared there; else it takes one of `pools: {services: N}`. Requests are kept while any function of the library runs, as
 * many as `queue:` says; what has no room waits at the agent. A service goes on by itself after a lost session.
 * XRCE carries no QoS of services: requests and replies are reliable between here and the agent, which has its own QoS
 * behind it. RCL_RET_SERVICE_NAME_INVALID for a name that ROS 2 refuses, RCL_RET_UNSUPPORTED for a QoS that XRCE cannot
 * carry, RCL_RET_TIMEOUT, else RCL_RET_ERROR with a text.
 */
rcl_ret_t rcl_service_init(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rcl_service_options_t * options);

/* Frees the service's place at once, with what waits in its queue; waits for the agent at most
 * MICROROS_CLOSE_TIMEOUT_MS. */
rcl_ret_t rcl_service_fini(rcl_service_t * service, rcl_node_t * node);

/* rmw_qos_profile_services_default */
rcl_service_options_t rcl_service_get_default_options(void);

/*
 * Receives what has come, without waiting, and decodes the oldest request into the storage that the message has; the header
 * says whose it is, and goes back with the reply. Several requests may be taken before the first is answered, in any order;
 * nothing of them is kept here. RCL_RET_SERVICE_TAKE_FAILED: there is none, or the stream is full and a reply would be
 * refused now: the request waits. RCL_RET_ERROR, with a text: a request that is larger than the service's limits, above a capacity
 * of the message, or no message of its type was thrown away. The next call goes on with the next one.
 */
rcl_ret_t rcl_take_request_with_info(
  const rcl_service_t * service, rmw_service_info_t * request_header, void * ros_request);

/* As rcl_take_request_with_info, without times. */
rcl_ret_t rcl_take_request(
  const rcl_service_t * service, rmw_request_id_t * request_header, void * ros_request);

/* Encodes the reply into the reliable stream and hands it to the transport; does not wait, unless `on_full` is block.
 * RCL_RET_ERROR, with a text: a field above its limit, or no room (what else was sent since the request was taken has filled the
 * stream: send it again later with the same header), or no session. */
rcl_ret_t rcl_send_response(
  const rcl_service_t * service, rmw_request_id_t * response_header, void * ros_response);

/* Returns the fully qualified name, which belongs to the service; NULL for an invalid one. */
const char * rcl_service_get_service_name(const rcl_service_t * service);

/* Return the QoS that was asked for, each default as what it means; NULL for an invalid one. What the agent has behind it is
 * its own. Belongs to the service. */
const rmw_qos_profile_t * rcl_service_request_subscription_get_actual_qos(const rcl_service_t * service);
const rmw_qos_profile_t * rcl_service_response_publisher_get_actual_qos(const rcl_service_t * service);

/* The same as options: the QoS is the actual one, the allocator the default one, since none is called. */
const rcl_service_options_t * rcl_service_get_options(const rcl_service_t * service);

rmw_service_t * rcl_service_get_rmw_handle(const rcl_service_t * service);

bool rcl_service_is_valid(const rcl_service_t * service);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_SERVICE_H */
