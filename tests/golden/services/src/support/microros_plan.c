/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/plan.h"

const MICROROS_FLASH microros_declared_node_t microros_declared_nodes[MICROROS_NODES_MAX] = {
  {"probe", "/", 0},
};

const MICROROS_FLASH microros_declared_endpoint_t microros_declared_endpoints[XRCE_ENDPOINTS] = {
  {"/set", MICROROS_FLASH_NAME("std_srvs::srv::dds_::SetBool_"), 0},
  {"/ask", MICROROS_FLASH_NAME("std_srvs::srv::dds_::SetBool_"), 0},
};
