/* SPDX-License-Identifier: Apache-2.0 */
/* Publishers, a subscription, a service server, a service client and a timer under one executor. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rcl_interfaces/srv/get_parameter_types.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#define CHECK(call) \
  if ((call) != RCL_RET_OK) { \
    return 1; \
  }

enum { HEARD = 1000, ANSWERED = 2000, ASK_EVERY = 10, HANDLES = 4 };

static rcl_publisher_t ticks;
static rcl_publisher_t seen;
static rcl_client_t client;
static std_msgs__msg__Int32 tick;
volatile uint32_t everything_refused; /* what the library did not take; read through the emulator */

static void count_refused(rcl_ret_t result)
{
  if (result != RCL_RET_OK) {
    everything_refused = everything_refused + 1u;
    rcl_reset_error();
  }
}

static void tell(int32_t value)
{
  const std_msgs__msg__Int32 message = {.data = value};

  count_refused(rcl_publish(&seen, &message, NULL));
}

static void ask(void)
{
  static char text[] = "lengths";
  rosidl_runtime_c__String names[2] = {{text, 3, sizeof(text)}, {text, 7, sizeof(text)}};
  rcl_interfaces__srv__GetParameterTypes_Request request = {.names = {names, 2, 2}};
  int64_t sequence = 0;

  count_refused(rcl_send_request(&client, &request, &sequence));
}

static void on_tick(rcl_timer_t * timer, int64_t last_call_time)
{
  RCLC_UNUSED(last_call_time);
  RCLC_UNUSED(timer);
  count_refused(rcl_publish(&ticks, &tick, NULL));
  if (++tick.data % ASK_EVERY == 0) {
    ask();
  }
}

static void on_message(const void * message)
{
  tell(HEARD + ((const std_msgs__msg__Int32 *)message)->data);
}

static void on_request(const void * asked, void * answer)
{
  const rcl_interfaces__srv__GetParameterTypes_Request * request = asked;
  rcl_interfaces__srv__GetParameterTypes_Response * response = answer;

  response->types.size = request->names.size;
  for (size_t i = 0; i < request->names.size; ++i) {
    response->types.data[i] = (uint8_t)request->names.data[i].size;
  }
}

static void on_reply(const void * answer)
{
  const rcl_interfaces__srv__GetParameterTypes_Response * response = answer;

  for (size_t i = 0; i < response->types.size; ++i) {
    tell(ANSWERED + response->types.data[i]);
  }
}

int main(void)
{
  static std_msgs__msg__Int32 heard;
  static rcl_interfaces__srv__GetParameterTypes_Request request;
  static rcl_interfaces__srv__GetParameterTypes_Response answer;
  static rcl_interfaces__srv__GetParameterTypes_Response reply;
  const rosidl_message_type_support_t * int32 = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const rosidl_service_type_support_t * types =
    ROSIDL_GET_SRV_TYPE_SUPPORT(rcl_interfaces, srv, GetParameterTypes);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node;
  rcl_subscription_t subscription;
  rcl_service_t service;
  rcl_timer_t timer;
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();

  CHECK(rclc_support_init(&support, 0, NULL, &allocator));
  CHECK(rclc_node_init_default(&node, "board", "", &support));
  CHECK(rclc_publisher_init_default(&ticks, &node, int32, "ticks"));
  CHECK(rclc_publisher_init_default(&seen, &node, int32, "seen"));
  CHECK(rclc_subscription_init_default(&subscription, &node, int32, "set"));
  CHECK(rclc_service_init_default(&service, &node, types, "lengths"));
  CHECK(rclc_client_init_default(&client, &node, types, "/peer/lengths"));
  CHECK(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(50), on_tick, true));
  CHECK(rclc_executor_init(&executor, &support.context, HANDLES, &allocator));
  CHECK(rclc_executor_add_timer(&executor, &timer));
  CHECK(rclc_executor_add_subscription(&executor, &subscription, &heard, on_message, ON_NEW_DATA));
  CHECK(rclc_executor_add_service(&executor, &service, &request, &answer, on_request));
  CHECK(rclc_executor_add_client(&executor, &client, &reply, on_reply));
  CHECK(rclc_executor_spin(&executor));
  return 0;
}
