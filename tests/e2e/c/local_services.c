/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node that serves /local/sum, and one that calls it inside the image. Ends with 0 when five requests of ROS were answered,
 * and each local one once. */
#include <example_interfaces/srv/add_two_ints.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <stdbool.h>

enum { FROM_ROS = 100000, ROS_REQUESTS = 5, TURNS = 20000, LAST_TURNS = 100 };

static int32_t asked_by_ros;
static int64_t asked;
static int64_t answered;
static bool wrong;

static void on_request(const void * request, void * response)
{
  const example_interfaces__srv__AddTwoInts_Request * numbers = request;
  example_interfaces__srv__AddTwoInts_Response * sum = response;

  sum->sum = numbers->a + numbers->b;
  if (numbers->a >= FROM_ROS) {
    ++asked_by_ros;
  } else {
    ++asked;
  }
}

static void on_reply(const void * response, rmw_request_id_t * request)
{
  const example_interfaces__srv__AddTwoInts_Response * sum = response;

  ++answered;
  wrong = wrong || request->sequence_number != answered || sum->sum != 2 * answered;
}

/* Serves while replies may still be on their way to the agent. */
static int end(rclc_executor_t * executor)
{
  for (int32_t i = 0; i < LAST_TURNS; ++i) {
    (void)rclc_executor_spin_some(executor, RCL_MS_TO_NS(10));
  }
  return wrong || asked != answered || asked_by_ros < ROS_REQUESTS;
}

int main(void)
{
  static example_interfaces__srv__AddTwoInts_Request request;
  static example_interfaces__srv__AddTwoInts_Response response;
  static example_interfaces__srv__AddTwoInts_Response received;
  const rosidl_service_type_support_t * type =
    ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t server = rcl_get_zero_initialized_node();
  rcl_node_t caller = rcl_get_zero_initialized_node();
  rcl_service_t service = rcl_get_zero_initialized_service();
  rcl_client_t client = rcl_get_zero_initialized_client();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&server, "server", "local", &support) != RCL_RET_OK ||
    rclc_node_init_default(&caller, "caller", "local", &support) != RCL_RET_OK ||
    rclc_service_init_default(&service, &server, type, "sum") != RCL_RET_OK ||
    rclc_client_init_default(&client, &caller, type, "sum") != RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, 2, &allocator) != RCL_RET_OK ||
    rclc_executor_add_service(&executor, &service, &request, &response, on_request) != RCL_RET_OK ||
    rclc_executor_add_client_with_request_id(&executor, &client, &received, on_reply) != RCL_RET_OK) {
    return 2;
  }
  for (int64_t turn = 1; turn <= TURNS && !wrong && asked_by_ros < ROS_REQUESTS; ++turn) {
    const example_interfaces__srv__AddTwoInts_Request numbers = {.a = turn, .b = turn};
    int64_t sequence = 0;

    if (rcl_send_request(&client, &numbers, &sequence) != RCL_RET_OK || sequence != turn) {
      return 3;
    }
    while (answered < turn) {
      if (rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10)) != RCL_RET_OK) {
        return 4;
      }
    }
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10));
  }
  return end(&executor);
}
