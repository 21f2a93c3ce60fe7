/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/logging_rosout.h"

#include "microros/cdr.h"
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_rosout.h"
#include "microros/rmw_node.h"
#include "microros/rmw_publisher.h"
#include "microros/xrce_rosout.h"
#include "rcl_interfaces/msg/log.h"
#include "rmw/qos_profiles.h"

#include <stddef.h>

enum { ROSOUT_DEPTH = 1000 }; /* lines that the agent keeps for late subscribers, as in ROS 2 */

/* Lines are encoded when they are logged (rcutils_rosout.c). */
static const microros_message_type_t rosout_message = {
  .dds_type_name = MICROROS_FLASH_NAME("rcl_interfaces::msg::dds_::Log_"),
  .max_encoded_size = rcl_interfaces__msg__Log__MAX_ENCODED_SIZE};

static const rosidl_message_type_support_t rosout_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &rosout_message};

static rmw_publisher_t * rosout_publisher;
static bool rosout_closed[MICROROS_NODES_MAX]; /* nodes that were closed and perhaps opened again */

static void rosout_use(const xrce_endpoint_t * writer)
{
  microros_lock();
  xrce_rosout_use(writer);
  microros_unlock();
}

rcl_ret_t rcl_rosout_open(const rcl_node_t * node)
{
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  rcl_ret_t result;

  if (rmw_node_index(node->impl) != 0u || rmw_publisher_is_open(rosout_publisher)) {
    return RCL_RET_OK;
  }
  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  qos.depth = ROSOUT_DEPTH;
  result = rmw_publisher_open(node->impl, &rosout_type, "/rosout", &qos, &rosout_publisher);
  if (result == RCL_RET_OK) {
    rosout_use(rosout_publisher->data);
  }
  return result;
}

void rcl_rosout_close(const rcl_node_t * node)
{
  const uint16_t index = rmw_node_index(node->impl);

  rosout_closed[index] = true;
  if (index == 0u && rmw_publisher_is_open(rosout_publisher)) { /* the node that it was opened with */
    rosout_use(NULL);
    rmw_publisher_close(rosout_publisher);
  }
}

bool rcl_rosout_was_closed(uint16_t node)
{
  const bool was_closed = rosout_closed[node];

  rosout_closed[node] = false;
  return was_closed;
}

rcl_ret_t rcl_logging_rosout_init(const rcl_allocator_t * allocator)
{
  return allocator == NULL ? microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "allocator") : RCL_RET_OK;
}

rcl_ret_t rcl_logging_rosout_fini(void)
{
  return RCL_RET_OK;
}

rcl_ret_t rcl_logging_rosout_init_publisher_for_node(rcl_node_t * node)
{
  return rcl_node_is_valid(node) ? rcl_rosout_open(node)
                                 : microros_error_refuse(RCL_RET_NODE_INVALID, "node");
}

rcl_ret_t rcl_logging_rosout_fini_publisher_for_node(rcl_node_t * node)
{
  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  rcl_rosout_close(node);
  return RCL_RET_OK;
}
