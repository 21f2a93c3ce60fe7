/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/node.h"

#include "microros/error.h"
#include "microros/rcl_node_open.h"

#include <stddef.h>

/* As in rclc, *node may be uninitialized memory. */
rcl_ret_t rclc_node_init_default(
  rcl_node_t * node, const char * name, const char * namespace_, rclc_support_t * support)
{
  if (node != NULL) {
    *node = rcl_get_zero_initialized_node();
  }
  if (support == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "support");
  }
  return rcl_node_open(node, name, namespace_, &support->context);
}

rcl_ret_t rclc_node_init_with_options(
  rcl_node_t * node, const char * name, const char * namespace_, rclc_support_t * support,
  rcl_node_options_t * node_ops)
{
  if (node_ops == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "node_ops");
  }
  return rclc_node_init_default(node, name, namespace_, support);
}
