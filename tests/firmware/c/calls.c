/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Calls a service and waits, is told of new messages, and takes its second node out of the executor for a while.
 * `calls_report`: the last sum, responses, time-outs, messages told, messages heard, the result of a call in a callback,
 * and messages heard while the node was away.
 */
#include <example_interfaces/srv/add_two_ints.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/executor_nodes.h>
#include <rclc/rclc.h>
#include <rclc/service_call.h>
#include <std_msgs/msg/int32.h>

enum { SUM, RESPONSES, TIME_OUTS, TOLD, HEARD, IN_CALLBACK, AWAY, REPORTS };
enum { AWAY_AFTER = 3, BACK_AFTER = 5 };

static rclc_support_t support;
static rcl_node_t asker;
static rcl_node_t listener;
static rcl_client_t client;
static rcl_subscription_t subscription;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static std_msgs__msg__Int32 number;
static example_interfaces__srv__AddTwoInts_Request request;
static example_interfaces__srv__AddTwoInts_Response response;

volatile uint32_t calls_report[REPORTS];

static rcl_ret_t call(void)
{
  return rclc_executor_call_service(&executor, &client, &request, &response, RCL_MS_TO_NS(500));
}

/* The callback of a subscription must not wait. */
static void on_number(const void * message)
{
  (void)message;
  ++calls_report[HEARD];
  calls_report[IN_CALLBACK] = (uint32_t)call();
}

static void on_new(const void * user_data, size_t number_of_events)
{
  (void)user_data;
  calls_report[TOLD] += (uint32_t)number_of_events;
}

static bool open_all(void)
{
  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&asker, "asker", "", &support) == RCL_RET_OK &&
         rclc_node_init_default(&listener, "listener", "", &support) == RCL_RET_OK &&
         rclc_client_init_default(
           &client, &asker, ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts), "/sum") ==
           RCL_RET_OK &&
         rclc_subscription_init_default(
           &subscription, &listener, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "/numbers") ==
           RCL_RET_OK &&
         rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK &&
         rclc_executor_add_subscription(&executor, &subscription, &number, on_number, ON_NEW_DATA) ==
           RCL_RET_OK &&
         rcl_subscription_set_on_new_message_callback(&subscription, on_new, NULL) == RCL_RET_OK;
}

static void ask(void)
{
  const rcl_ret_t result = call();

  if (result == RCL_RET_OK) {
    calls_report[SUM] = (uint32_t)response.sum;
    ++calls_report[RESPONSES];
    ++request.a;
  } else if (result == RCL_RET_TIMEOUT) {
    ++calls_report[TIME_OUTS];
  }
}

int main(void)
{
  bool away = false;
  bool was_away = false;

  allocator = rcl_get_default_allocator();
  request.a = 40;
  request.b = 2;
  if (!open_all()) {
    return 1;
  }
  for (;;) {
    ask();
    if (rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10)) != RCL_RET_OK) {
      return 1;
    }
    if (!away && !was_away && calls_report[HEARD] == AWAY_AFTER) {
      away = rclc_executor_remove_node(&executor, &listener) == RCL_RET_OK;
      was_away = away;
    }
    if (away && calls_report[TOLD] == BACK_AFTER) {
      calls_report[AWAY] = calls_report[HEARD] - AWAY_AFTER;
      away = rclc_executor_add_node(&executor, &listener) != RCL_RET_OK;
    }
  }
}
