/* SPDX-License-Identifier: Apache-2.0 */
/* A server of std_srvs/srv/SetBool under an executor: its size is a figure of docs/verification/figures.md. */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_srvs/srv/set_bool.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_service_t service;
static rclc_executor_t executor;
static std_srvs__srv__SetBool_Request request;
static std_srvs__srv__SetBool_Response response;

static void answer(const void * request_msg, void * response_msg)
{
  const std_srvs__srv__SetBool_Request * asked = request_msg;
  std_srvs__srv__SetBool_Response * said = response_msg;

  said->success = asked->data;
  said->message.data[0] = 'o';
  said->message.data[1] = 'k';
  said->message.data[2] = '\0';
  said->message.size = 2;
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "server", "", &support) != RCL_RET_OK ||
    rclc_service_init_default(
      &service, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool), "set_bool") != RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, 1, &allocator) != RCL_RET_OK ||
    rclc_executor_add_service(&executor, &service, &request, &response, answer) != RCL_RET_OK) {
    return 1;
  }
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100));
  }
}
