/* SPDX-License-Identifier: Apache-2.0 */
/* Modes that a contingency requests. */
#include "microros/rclc_modes_request.h"

#include "microros/rclc_modes_known.h"
#include "microros/rmw_node.h"
#include "microros_config.h"

#include <stddef.h>

static rclc_modes_t * modes_of[MICROROS_NODES_MAX];

void rclc_modes_register(rclc_modes_t * modes)
{
  modes_of[rmw_node_index(modes->lifecycle_node->node->impl)] = modes;
}

void rclc_modes_remove(const rclc_modes_t * modes)
{
  modes_of[rmw_node_index(modes->lifecycle_node->node->impl)] = NULL;
}

bool rclc_modes_request(uint16_t node, const char * mode)
{
  rclc_modes_t * modes = node < (uint16_t)MICROROS_NODES_MAX ? modes_of[node] : NULL;
  const uint8_t wanted = rclc_modes_find(modes, mode);

  return modes != NULL &&
         (rclc_modes_get(modes) == wanted || rclc_modes_reconfigure(modes, wanted) == RCL_RET_OK);
}
