/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Whether a server of the image is available: the application file is that of test_local_services.py. The graph server,
 * which nobody runs here, is not asked. */
#include "port_agent.h"
#include "unit.h"

#include <example_interfaces/srv/add_two_ints.h>
#include <rcl/graph.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>

int main(void)
{
  const rosidl_service_type_support_t * type =
    ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_service_t service = rcl_get_zero_initialized_service();
  rcl_client_t client = rcl_get_zero_initialized_client();
  bool is_available = true;

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_client_init_default(&client, &node, type, "sum") == RCL_RET_OK);
  CHECK(rcl_service_server_is_available(&node, &client, &is_available) == RCL_RET_OK && !is_available);
  CHECK(rclc_service_init_default(&service, &node, type, "sum") == RCL_RET_OK);
  CHECK(rcl_service_server_is_available(&node, &client, &is_available) == RCL_RET_OK && is_available);
  CHECK(rcl_service_fini(&service, &node) == RCL_RET_OK);
  CHECK(rcl_service_server_is_available(&node, &client, &is_available) == RCL_RET_OK && !is_available);
  CHECK(rcl_client_fini(&client, &node) == RCL_RET_OK && rcl_node_fini(&node) == RCL_RET_OK);
  CHECK(rclc_support_fini(&support) == RCL_RET_OK);
  return 0;
}
