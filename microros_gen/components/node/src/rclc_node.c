/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/node.h"

#include "microros/error.h"

#include <stddef.h>

rcl_ret_t rclc_node_init_with_options(
  rcl_node_t * node, const char * name, const char * namespace_, rclc_support_t * support,
  rcl_node_options_t * node_ops)
{
  if (node == NULL || support == NULL) {
    microros_error_set(MICROROS_ERROR_ARGUMENT, "node or support", NULL, 0, 0);
    return RCL_RET_INVALID_ARGUMENT;
  }
  *node = rcl_get_zero_initialized_node(); /* as rclc does: the caller's may be uninitialized memory */
  return rcl_node_init(node, name, namespace_, &support->context, node_ops);
}

rcl_ret_t rclc_node_init_default(
  rcl_node_t * node, const char * name, const char * namespace_, rclc_support_t * support)
{
  rcl_node_options_t options = rcl_node_get_default_options();

  return rclc_node_init_with_options(node, name, namespace_, support, &options);
}
