/* SPDX-License-Identifier: Apache-2.0 */
/*
 * For a component that opens endpoints by itself (`implies:`), where nodes are declared: the plan has their places, so no
 * name is expanded, checked or compared, and no QoS is converted. They are reliable and volatile. Internal. */
#ifndef MICROROS_RMW_BY_PLACE_H
#define MICROROS_RMW_BY_PLACE_H

#include <stdint.h>

#include "microros/rmw_node.h"
#include "rmw/types.h"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As rmw_publisher_open, with the first publisher of this type that the plan has for the node. */
rmw_ret_t rmw_publisher_open_by_place(
  const rmw_node_t * node, const rosidl_message_type_support_t * type_support, uint16_t depth,
  rmw_publisher_t ** publisher);

/*
 * As rmw_replier_open, with the next service of this type that the plan has for the node, at or after the endpoint with
 * index *at (at first 0), which becomes the one after it. A component opens its services in the order in which it declares
 * them. */
rmw_ret_t rmw_replier_open_by_place(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, uint16_t depth, uint16_t * at,
  rmw_service_t ** service);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_BY_PLACE_H */
