/* SPDX-License-Identifier: Apache-2.0 */
/* Calls of rclc in every state: compiled once against ros2/rclc over librcl, whose answers are in states_rclc.txt, and
 * against the generated library. */
#include "tell.h"

#include <rcl/guard_condition.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>
#include <std_srvs/srv/set_bool.h>
#include <string.h>

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static std_msgs__msg__Int32 message;
static std_srvs__srv__SetBool_Request request;
static std_srvs__srv__SetBool_Response response;
static int calls;

static void on_message(const void * taken)
{
  (void)taken;
  ++calls;
}

static void on_service(const void * asked, void * answer)
{
  (void)asked;
  (void)answer;
  ++calls;
}

static void on_message_in(const void * taken, void * context)
{
  (void)taken;
  (void)context;
  ++calls;
}

static void on_request_of(const void * asked, rmw_request_id_t * id, void * answer)
{
  (void)asked;
  (void)id;
  (void)answer;
  ++calls;
}

static void on_request_in(const void * asked, void * answer, void * context)
{
  (void)asked;
  (void)answer;
  (void)context;
  ++calls;
}

static void on_reply_of(const void * taken, rmw_request_id_t * id)
{
  (void)taken;
  (void)id;
  ++calls;
}

static void on_time(rcl_timer_t * timer, int64_t since)
{
  (void)timer;
  (void)since;
  ++calls;
}

static void on_guard(void)
{
  ++calls;
}

static void start(void)
{
  rcl_init_options_t none = rcl_get_zero_initialized_init_options();

  TELL(rclc_support_init(NULL, 0, NULL, &allocator));
  TELL(rclc_support_init(&support, 0, NULL, NULL));
  TELL(rclc_support_init_with_options(&support, 0, NULL, NULL, &allocator));
  TELL(rclc_support_init_with_options(&support, 0, NULL, &none, NULL));
  TELL(rclc_support_fini(NULL));
  TELL(rclc_support_init(&support, 0, NULL, &allocator));
  TELL(rclc_node_init_default(NULL, "n", "", &support));
  TELL(rclc_node_init_default(&node, NULL, "", &support));
  TELL(rclc_node_init_default(&node, "n", NULL, &support));
  TELL(rclc_node_init_default(&node, "n", "", NULL));
  TELL(rclc_node_init_default(&node, "a b", "", &support));
  TELL(rclc_node_init_default(&node, "n", "a b", &support));
  TELL(rclc_node_init_with_options(&node, "n", "", &support, NULL));
  TELL(rclc_node_init_default(&node, "n", "", &support));
  TELL(rcl_node_is_valid(&node));
}

static void endpoints(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const rosidl_service_type_support_t * service_type = ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool);
  rcl_node_t nothing = rcl_get_zero_initialized_node();
  rcl_publisher_t publisher;
  rcl_subscription_t subscription;
  rcl_service_t service;
  rcl_client_t client;

  memset(&publisher, 0x5a, sizeof(publisher)); /* whatever there was */
  memset(&subscription, 0x5a, sizeof(subscription));
  memset(&service, 0x5a, sizeof(service));
  memset(&client, 0x5a, sizeof(client));
  TELL(rclc_publisher_init_default(NULL, &node, type, "a"));
  TELL(rclc_publisher_init_default(&publisher, NULL, type, "a"));
  TELL(rclc_publisher_init_default(&publisher, &node, NULL, "a"));
  TELL(rclc_publisher_init_default(&publisher, &node, type, NULL));
  TELL(rclc_publisher_init(&publisher, &node, type, "a", NULL));
  TELL(rclc_publisher_init_default(&publisher, &nothing, type, "a"));
  TELL(rclc_publisher_init_default(&publisher, &node, type, "a b"));
  TELL(rclc_publisher_init_best_effort(&publisher, &node, type, "a"));
  TELL(rcl_publisher_is_valid(&publisher));
  TELL(rcl_publisher_fini(&publisher, &node));
  TELL(rclc_publisher_init_default(&publisher, &node, type, "a"));
  TELL(rcl_publish(&publisher, &message, NULL));
  TELL(rcl_publisher_fini(&publisher, &node));
  TELL(rcl_publisher_fini(&publisher, &node));
  TELL(rclc_subscription_init_default(NULL, &node, type, "b"));
  TELL(rclc_subscription_init_default(&subscription, NULL, type, "b"));
  TELL(rclc_subscription_init_default(&subscription, &node, NULL, "b"));
  TELL(rclc_subscription_init_default(&subscription, &node, type, NULL));
  TELL(rclc_subscription_init(&subscription, &node, type, "b", NULL));
  TELL(rclc_subscription_init_default(&subscription, &nothing, type, "b"));
  TELL(rclc_subscription_init_default(&subscription, &node, type, "1"));
  TELL(rclc_subscription_init_best_effort(&subscription, &node, type, "b"));
  TELL(rcl_subscription_fini(&subscription, &node));
  TELL(rclc_service_init_default(NULL, &node, service_type, "c"));
  TELL(rclc_service_init_default(&service, NULL, service_type, "c"));
  TELL(rclc_service_init_default(&service, &node, NULL, "c"));
  TELL(rclc_service_init_default(&service, &node, service_type, NULL));
  TELL(rclc_service_init(&service, &node, service_type, "c", NULL));
  TELL(rclc_service_init_default(&service, &nothing, service_type, "c"));
  TELL(rclc_service_init_default(&service, &node, service_type, "c//c"));
  TELL(rclc_service_init_default(&service, &node, service_type, "c"));
  TELL(rcl_service_fini(&service, &node));
  TELL(rclc_client_init_default(NULL, &node, service_type, "d"));
  TELL(rclc_client_init_default(&client, NULL, service_type, "d"));
  TELL(rclc_client_init_default(&client, &node, NULL, "d"));
  TELL(rclc_client_init_default(&client, &node, service_type, NULL));
  TELL(rclc_client_init(&client, &node, service_type, "d", NULL));
  TELL(rclc_client_init_default(&client, &nothing, service_type, "d"));
  TELL(rclc_client_init_default(&client, &node, service_type, ""));
  TELL(rclc_client_init_default(&client, &node, service_type, "d"));
  TELL(rcl_client_fini(&client, &node));
}

static void timers(void)
{
  rcl_timer_t timer = rcl_get_zero_initialized_timer();

  TELL(rclc_timer_init_default(NULL, &support, 5, on_time));
  TELL(rclc_timer_init_default(&timer, NULL, 5, on_time));
  TELL(rclc_timer_init_default2(&timer, &support, RCL_S_TO_NS(1000), on_time, false));
  TELL(rclc_timer_init_default2(NULL, &support, 5, on_time, true));
  TELL(rclc_timer_init_default2(&timer, NULL, 5, on_time, true));
  TELL(rcl_timer_fini(&timer));
  TELL(rclc_timer_init_default(&timer, &support, RCL_S_TO_NS(1000), on_time));
  TELL(rcl_timer_fini(&timer));
}

/* What an executor says that was never initialized, or was finalized. */
static void without(rclc_executor_t * executor, rcl_subscription_t * subscription, rcl_timer_t * timer)
{
  TELL(rclc_executor_set_timeout(executor, 5));
  TELL(rclc_executor_set_semantics(executor, RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME));
  TELL(rclc_executor_add_timer(executor, timer));
  TELL(rclc_executor_add_subscription(executor, subscription, &message, on_message, ON_NEW_DATA));
  TELL(rclc_executor_remove_timer(executor, timer));
  TELL(rclc_executor_spin_some(executor, 1));
  TELL(rclc_executor_spin_one_period(executor, 1));
  TELL(rclc_executor_set_trigger(executor, rclc_executor_trigger_any, NULL));
  TELL(rclc_executor_fini(executor));
}

static void add(
  rclc_executor_t * executor, rcl_subscription_t * subscription, rcl_timer_t * timer,
  rcl_guard_condition_t * guard, rcl_service_t * service, rcl_client_t * client)
{
  TELL(rclc_executor_add_timer(executor, NULL));
  TELL(rclc_executor_add_timer(NULL, timer));
  TELL(rclc_executor_add_timer(executor, timer));
  TELL(rclc_executor_add_subscription(executor, NULL, &message, on_message, ON_NEW_DATA));
  TELL(rclc_executor_add_subscription(executor, subscription, NULL, on_message, ON_NEW_DATA));
  TELL(rclc_executor_add_subscription(executor, subscription, &message, NULL, ON_NEW_DATA));
  TELL(rclc_executor_add_subscription(executor, subscription, &message, NULL, ALWAYS));
  TELL(rclc_executor_remove_subscription(executor, subscription));
  TELL(rclc_executor_add_subscription(executor, subscription, &message, on_message, ON_NEW_DATA));
  TELL(rclc_executor_add_guard_condition(executor, guard, NULL));
  TELL(rclc_executor_add_guard_condition(executor, NULL, on_guard));
  TELL(rclc_executor_add_guard_condition(executor, guard, on_guard));
  TELL(rclc_executor_add_service(executor, NULL, &request, &response, on_service));
  TELL(rclc_executor_add_service(executor, service, NULL, &response, on_service));
  TELL(rclc_executor_add_service(executor, service, &request, NULL, on_service));
  TELL(rclc_executor_add_service(executor, service, &request, &response, NULL));
  TELL(rclc_executor_add_service(executor, service, &request, &response, on_service));
  TELL(rclc_executor_add_client(executor, NULL, &response, on_message));
  TELL(rclc_executor_add_client(executor, client, NULL, on_message));
  TELL(rclc_executor_add_client(executor, client, &response, NULL));
  TELL(rclc_executor_add_client(executor, client, &response, on_message));
}

static void spin(rclc_executor_t * executor, rcl_guard_condition_t * guard)
{
  TELL(rclc_executor_set_timeout(executor, RCL_MS_TO_NS(5)));
  TELL(rclc_executor_set_timeout(NULL, 5));
  TELL(rclc_executor_set_semantics(executor, RCLC_SEMANTICS_RCLCPP_EXECUTOR));
  TELL(rclc_executor_set_semantics(NULL, RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME));
  TELL(rclc_executor_set_trigger(NULL, rclc_executor_trigger_any, NULL));
  TELL(rclc_executor_prepare(executor));
  TELL(rclc_executor_prepare(NULL));
  calls = 0;
  TELL(rclc_executor_spin_some(executor, RCL_MS_TO_NS(1)));
  TELL(calls);
  TELL(rcl_trigger_guard_condition(guard));
  TELL(rclc_executor_spin_some(executor, RCL_MS_TO_NS(100)));
  TELL(calls);
  TELL(rclc_executor_set_semantics(executor, RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME));
  TELL(rcl_trigger_guard_condition(guard));
  TELL(rclc_executor_spin_some(executor, RCL_MS_TO_NS(100)));
  TELL(calls);
  TELL(rclc_executor_set_trigger(executor, rclc_executor_trigger_all, NULL));
  TELL(rcl_trigger_guard_condition(guard));
  TELL(rclc_executor_spin_some(executor, RCL_MS_TO_NS(1)));
  TELL(calls);
  TELL(rclc_executor_set_trigger(executor, rclc_executor_trigger_one, guard));
  TELL(rcl_trigger_guard_condition(guard));
  TELL(rclc_executor_spin_some(executor, RCL_MS_TO_NS(100)));
  TELL(calls);
  TELL(rclc_executor_spin_some(NULL, 1));
  TELL(rclc_executor_spin(NULL));
  TELL(rclc_executor_spin_period(NULL, 1));
  TELL(rclc_executor_spin_one_period(NULL, 1));
  TELL(rclc_executor_spin_one_period(executor, RCL_MS_TO_NS(1)));
}

static void executors(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const rosidl_service_type_support_t * service_type = ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool);
  rcl_guard_condition_t guard = rcl_get_zero_initialized_guard_condition();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  rcl_subscription_t subscription;
  rcl_service_t service;
  rcl_client_t client;

  TELL(rclc_timer_init_default2(&timer, &support, RCL_S_TO_NS(1000), on_time, true));
  TELL(rclc_subscription_init_default(&subscription, &node, type, "b"));
  TELL(rclc_service_init_default(&service, &node, service_type, "c"));
  TELL(rclc_client_init_default(&client, &node, service_type, "d"));
  TELL(rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()));
  without(&executor, &subscription, &timer);
  TELL(rclc_executor_init(NULL, &support.context, 5, &allocator));
  TELL(rclc_executor_init(&executor, NULL, 5, &allocator));
  TELL(rclc_executor_init(&executor, &support.context, 0, &allocator));
  TELL(rclc_executor_init(&executor, &support.context, 5, NULL));
  TELL(rclc_executor_init(&executor, &support.context, 5, &allocator));
  TELL(rclc_executor_spin_some(&executor, 1));
  TELL(rclc_executor_remove_timer(&executor, &timer));
  TELL(rclc_executor_remove_timer(&executor, NULL));
  add(&executor, &subscription, &timer, &guard, &service, &client);
  spin(&executor, &guard);
  TELL(rclc_executor_remove_service(&executor, &service));
  TELL(rclc_executor_remove_service(&executor, &service));
  TELL(rclc_executor_remove_client(&executor, &client));
  TELL(rclc_executor_remove_client(&executor, NULL));
  TELL(rclc_executor_remove_timer(&executor, &timer));
  TELL(rclc_executor_remove_subscription(&executor, &subscription));
  TELL(rclc_executor_remove_subscription(&executor, &subscription));
  TELL(rclc_executor_spin_some(&executor, 1));
  TELL(rclc_executor_fini(NULL));
  TELL(rclc_executor_fini(&executor));
  TELL(rclc_executor_fini(&executor));
  without(&executor, &subscription, &timer);
  TELL(rclc_executor_init(&executor, &support.context, 5, &allocator));
  TELL(rclc_executor_add_timer(&executor, &timer));
  TELL(rcl_client_fini(&client, &node));
  TELL(rcl_service_fini(&service, &node));
  TELL(rcl_subscription_fini(&subscription, &node));
  TELL(rclc_executor_spin_some(&executor, 1));
  TELL(rcl_shutdown(&support.context));
  TELL(rclc_executor_spin_some(&executor, 1));
  TELL(rclc_executor_spin(&executor));
  TELL(rclc_executor_fini(&executor));
  TELL(rcl_timer_fini(&timer));
  TELL(rcl_guard_condition_fini(&guard));
}

/* Callbacks with a context or the id of a request, guard conditions, and what removes them. */
static void add_others(
  rclc_executor_t * executor, rcl_subscription_t * subscription, rcl_guard_condition_t * guard,
  rcl_service_t * service, rcl_client_t * client)
{
  TELL(
    rclc_executor_add_subscription_with_context(NULL, subscription, &message, on_message_in, &calls, ALWAYS));
  TELL(rclc_executor_add_subscription_with_context(executor, NULL, &message, on_message_in, &calls, ALWAYS));
  TELL(
    rclc_executor_add_subscription_with_context(executor, subscription, NULL, on_message_in, &calls, ALWAYS));
  TELL(rclc_executor_add_subscription_with_context(executor, subscription, &message, NULL, &calls, ALWAYS));
  TELL(rclc_executor_add_subscription_with_context(
    executor, subscription, &message, on_message_in, NULL, ALWAYS));
  TELL(rclc_executor_add_service_with_request_id(NULL, service, &request, &response, on_request_of));
  TELL(rclc_executor_add_service_with_request_id(executor, NULL, &request, &response, on_request_of));
  TELL(rclc_executor_add_service_with_request_id(executor, service, NULL, &response, on_request_of));
  TELL(rclc_executor_add_service_with_request_id(executor, service, &request, NULL, on_request_of));
  TELL(rclc_executor_add_service_with_request_id(executor, service, &request, &response, NULL));
  TELL(rclc_executor_add_service_with_request_id(executor, service, &request, &response, on_request_of));
  TELL(rclc_executor_remove_service(executor, service));
  TELL(rclc_executor_add_service_with_context(NULL, service, &request, &response, on_request_in, &calls));
  TELL(rclc_executor_add_service_with_context(executor, NULL, &request, &response, on_request_in, &calls));
  TELL(rclc_executor_add_service_with_context(executor, service, NULL, &response, on_request_in, &calls));
  TELL(rclc_executor_add_service_with_context(executor, service, &request, NULL, on_request_in, &calls));
  TELL(rclc_executor_add_service_with_context(executor, service, &request, &response, NULL, &calls));
  TELL(rclc_executor_add_service_with_context(executor, service, &request, &response, on_request_in, NULL));
  TELL(rclc_executor_add_client_with_request_id(NULL, client, &response, on_reply_of));
  TELL(rclc_executor_add_client_with_request_id(executor, NULL, &response, on_reply_of));
  TELL(rclc_executor_add_client_with_request_id(executor, client, NULL, on_reply_of));
  TELL(rclc_executor_add_client_with_request_id(executor, client, &response, NULL));
  TELL(rclc_executor_add_client_with_request_id(executor, client, &response, on_reply_of));
  TELL(rclc_executor_add_guard_condition(NULL, guard, on_guard));
  TELL(rclc_executor_add_guard_condition(executor, guard, on_guard));
}

static void remove_others(
  rclc_executor_t * executor, rcl_subscription_t * subscription, rcl_guard_condition_t * guard,
  rcl_service_t * service, rcl_client_t * client)
{
  TELL(rclc_executor_remove_guard_condition(NULL, guard));
  TELL(rclc_executor_remove_guard_condition(executor, NULL));
  TELL(rclc_executor_remove_guard_condition(executor, guard));
  TELL(rclc_executor_remove_guard_condition(executor, guard));
  TELL(rclc_executor_remove_client(NULL, client));
  TELL(rclc_executor_remove_client(executor, client));
  TELL(rclc_executor_remove_client(executor, client));
  TELL(rclc_executor_remove_service(NULL, service));
  TELL(rclc_executor_remove_service(executor, NULL));
  TELL(rclc_executor_remove_service(executor, service));
  TELL(rclc_executor_remove_subscription(NULL, subscription));
  TELL(rclc_executor_remove_subscription(executor, NULL));
  TELL(rclc_executor_remove_subscription(executor, subscription));
  TELL(rclc_executor_remove_timer(NULL, NULL));
}

/* Which handles a trigger lets run; ALWAYS calls without a message, too. */
static void triggers(rclc_executor_t * executor, rcl_guard_condition_t * guard)
{
  calls = 0;
  TELL(rclc_executor_set_trigger(executor, rclc_executor_trigger_always, NULL));
  TELL(rclc_executor_spin_some(executor, RCL_MS_TO_NS(1)));
  TELL(calls);
  TELL(rclc_executor_set_trigger(executor, rclc_executor_trigger_any, NULL));
  TELL(rclc_executor_spin_some(executor, RCL_MS_TO_NS(1)));
  TELL(calls);
  TELL(rcl_trigger_guard_condition(guard));
  TELL(rclc_executor_spin_some(executor, RCL_MS_TO_NS(100)));
  TELL(calls);
}

/* The functions of executor_handle.h. */
static void handles(rcl_guard_condition_t * guard)
{
  rclc_executor_handle_counters_t counters;
  rclc_executor_handle_t handle;

  TELL(rclc_executor_handle_counters_zero_init(NULL));
  TELL(rclc_executor_handle_counters_zero_init(&counters));
  TELL(counters.number_of_subscriptions);
  TELL(rclc_executor_handle_init(NULL, 1));
  TELL(rclc_executor_handle_init(&handle, 3));
  TELL(handle.initialized);
  TELL(rclc_executor_handle_get_ptr(&handle) == NULL);
  TELL(rclc_executor_handle_print(NULL));
  TELL(rclc_executor_handle_print(&handle));
  handle.type = RCLC_GUARD_CONDITION;
  handle.gc = guard;
  TELL(rclc_executor_handle_get_ptr(&handle) == guard);
  TELL(rclc_executor_handle_print(&handle));
  TELL(rclc_executor_handle_clear(NULL, 1));
  TELL(rclc_executor_handle_clear(&handle, 3));
}

static void others(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const rosidl_service_type_support_t * service_type = ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool);
  rcl_guard_condition_t guard = rcl_get_zero_initialized_guard_condition();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  rcl_subscription_t subscription;
  rcl_service_t service;
  rcl_client_t client;

  TELL(rclc_subscription_init(&subscription, &node, type, "b", &rmw_qos_profile_default));
  TELL(rclc_service_init_best_effort(NULL, &node, service_type, "c"));
  TELL(rclc_service_init_best_effort(&service, &node, service_type, "c"));
  TELL(rclc_client_init_best_effort(NULL, &node, service_type, "d"));
  TELL(rclc_client_init_best_effort(&client, &node, service_type, "d"));
  TELL(rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()));
  handles(&guard);
  TELL(rclc_executor_add_guard_condition(&executor, &guard, on_guard));
  TELL(rclc_executor_init(&executor, &support.context, 4, &allocator));
  TELL(rclc_executor_remove_guard_condition(&executor, &guard));
  TELL(rclc_executor_remove_client(&executor, &client));
  add_others(&executor, &subscription, &guard, &service, &client);
  triggers(&executor, &guard);
  remove_others(&executor, &subscription, &guard, &service, &client);
  TELL(rclc_executor_spin_some(&executor, 1));
  TELL(rclc_executor_prepare(&executor));
  TELL(rclc_executor_fini(&executor));
  TELL(rcl_guard_condition_fini(&guard));
  TELL(rcl_client_fini(&client, &node));
  TELL(rcl_service_fini(&service, &node));
  TELL(rcl_subscription_fini(&subscription, &node));
}

int main(void)
{
  allocator = heap;
  memset(&support, 0, sizeof(support));
  start();
  endpoints();
  timers();
  executors();
  TELL(rcl_node_fini(&node));
  TELL(rclc_support_fini(&support));
  TELL(rclc_support_fini(&support));
  start();
  endpoints();
  others();
  TELL(rcl_node_fini(&node));
  TELL(rclc_support_fini(&support));
  return 0;
}
