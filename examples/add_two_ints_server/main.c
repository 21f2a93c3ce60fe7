/* SPDX-License-Identifier: Apache-2.0 */
/* A service that adds two numbers; up to four requests wait while it is busy. */
#include "../example.h"

#include <example_interfaces/srv/add_two_ints.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <inttypes.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_service_t service;
static rclc_executor_t executor;
static example_interfaces__srv__AddTwoInts_Request request;
static example_interfaces__srv__AddTwoInts_Response response;

static void add(const void * request_message, void * response_message)
{
  const example_interfaces__srv__AddTwoInts_Request * asked = request_message;
  example_interfaces__srv__AddTwoInts_Response * answer = response_message;

  answer->sum = asked->a + asked->b;
  (void)printf("%" PRId64 " + %" PRId64 " = %" PRId64 "\n", asked->a, asked->b, answer->sum);
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "adder", "", &support), "node");
  example_check(
    rclc_service_init_default(
      &service, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts), "add_two_ints"),
    "service");

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  example_check(rclc_executor_add_service(&executor, &service, &request, &response, add), "add service");
  while (example_runs()) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rcl_service_fini(&service, &node), "end of the service");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
