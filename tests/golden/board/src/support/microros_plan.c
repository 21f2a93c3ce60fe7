/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/plan.h"

const microros_declared_node_t microros_declared_nodes[MICROROS_NODES_MAX] = {
  {"probe", "/", 0},
};

const microros_declared_endpoint_t microros_declared_endpoints[XRCE_ENDPOINTS] = {
  {"/fast", "std_msgs::msg::dds_::Int32_", 0},
  {"/sure", "std_msgs::msg::dds_::Header_", 0},
};
