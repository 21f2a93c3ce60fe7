/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/plan.h"

const MICROROS_FLASH microros_declared_node_t microros_declared_nodes[MICROROS_NODES_MAX] = {
  {"probe", "/", 0},
};

const MICROROS_FLASH microros_declared_endpoint_t microros_declared_endpoints[XRCE_ENDPOINTS] = {
  {"/fast", MICROROS_FLASH_NAME("std_msgs::msg::dds_::Int32_"), 0},
  {"/sure", MICROROS_FLASH_NAME("std_msgs::msg::dds_::Header_"), 0},
  {"/heard", MICROROS_FLASH_NAME("std_msgs::msg::dds_::Int32_"), 0},
  {"/said", MICROROS_FLASH_NAME("std_msgs::msg::dds_::String_"), 0},
};
