/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Two nodes of one chip, each with an executor in a separate task: the application file is that of
 * test_local_services.py. The sensor publishes numbers and asks for sums, the filter hears and adds.
 */
#include "unit.h"

#include <example_interfaces/srv/add_two_ints.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <pthread.h>
#include <stdatomic.h>

enum { ROUNDS = 300 };

static rclc_support_t support;
static rcl_publisher_t publisher;
static rcl_client_t client;
static atomic_int heard; /* by the filter, read by the sensor */
static atomic_bool over;
static int32_t answered; /* by the sensor's task alone */

static void on_number(const void * message)
{
  const std_msgs__msg__Int32 * number = message;

  CHECK(number->data == atomic_load(&heard) + 1);
  atomic_store(&heard, number->data);
}

static void on_request(const void * request, void * response)
{
  const example_interfaces__srv__AddTwoInts_Request * asked = request;
  example_interfaces__srv__AddTwoInts_Response * answer = response;

  answer->sum = asked->a + asked->b;
}

static void on_reply(const void * response)
{
  const example_interfaces__srv__AddTwoInts_Response * answer = response;

  ++answered;
  CHECK(answer->sum == answered + 1);
}

static void * run_filter(void * context)
{
  rclc_executor_t * executor = context;

  while (!atomic_load(&over)) {
    CHECK(rclc_executor_spin_some(executor, RCL_MS_TO_NS(100)) == RCL_RET_OK);
  }
  return NULL;
}

/* One number and one request in each round; each is waited for, so that no queue overflows. */
static void run_sensor(rclc_executor_t * executor)
{
  for (int32_t round = 1; round <= ROUNDS; ++round) {
    const std_msgs__msg__Int32 message = {.data = round};
    const example_interfaces__srv__AddTwoInts_Request request = {.a = round, .b = 1};
    int64_t sequence = 0;

    CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
    CHECK(rcl_send_request(&client, &request, &sequence) == RCL_RET_OK && sequence == round);
    while (answered < round || atomic_load(&heard) < round) {
      CHECK(rclc_executor_spin_some(executor, RCL_MS_TO_NS(10)) == RCL_RET_OK);
    }
  }
}

int main(void)
{
  static std_msgs__msg__Int32 message;
  static example_interfaces__srv__AddTwoInts_Request request;
  static example_interfaces__srv__AddTwoInts_Response response;
  static example_interfaces__srv__AddTwoInts_Response received;
  const rosidl_message_type_support_t * number = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const rosidl_service_type_support_t * sum =
    ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_node_t sensor = rcl_get_zero_initialized_node();
  rcl_node_t filter = rcl_get_zero_initialized_node();
  rcl_subscription_t subscription = rcl_get_zero_initialized_subscription();
  rcl_service_t service = rcl_get_zero_initialized_service();
  rclc_executor_t of_sensor = rclc_executor_get_zero_initialized_executor();
  rclc_executor_t of_filter = rclc_executor_get_zero_initialized_executor();
  pthread_t task;

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&sensor, "sensor", "", &support) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&filter, "filter", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&publisher, &sensor, number, "/count") == RCL_RET_OK);
  CHECK(rclc_client_init_default(&client, &sensor, sum, "/sum") == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscription, &filter, number, "/count") == RCL_RET_OK);
  CHECK(rclc_service_init_default(&service, &filter, sum, "/sum") == RCL_RET_OK);
  CHECK(rclc_executor_init(&of_sensor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_init(&of_filter, &support.context, 2, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_add_client(&of_sensor, &client, &received, on_reply) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&of_filter, &subscription, &message, on_number, ON_NEW_DATA) ==
    RCL_RET_OK);
  CHECK(rclc_executor_add_service(&of_filter, &service, &request, &response, on_request) == RCL_RET_OK);
  CHECK(pthread_create(&task, NULL, run_filter, &of_filter) == 0);
  run_sensor(&of_sensor);
  atomic_store(&over, true);
  CHECK(pthread_join(task, NULL) == 0);
  CHECK(rclc_executor_fini(&of_sensor) == RCL_RET_OK && rclc_executor_fini(&of_filter) == RCL_RET_OK);
  CHECK(rcl_service_fini(&service, &filter) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&subscription, &filter) == RCL_RET_OK);
  CHECK(rcl_client_fini(&client, &sensor) == RCL_RET_OK);
  CHECK(rcl_publisher_fini(&publisher, &sensor) == RCL_RET_OK);
  CHECK(rcl_node_fini(&filter) == RCL_RET_OK && rcl_node_fini(&sensor) == RCL_RET_OK);
  CHECK(rclc_support_fini(&support) == RCL_RET_OK);
  return 0;
}
