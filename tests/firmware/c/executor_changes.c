/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Two executors of a board, without an agent: handles of every kind are added, removed and made ready in an order that
 * chance decides, between rounds and within callbacks, while an interrupt triggers a guard condition and the clock wraps. Each
 * callback has to be one of an executor that has its handle. Ends the emulator with status 0 if all went well.
 */
#include "emulator_end.h"

#include <microros/port.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <example_interfaces/srv/add_two_ints.h>
#include <std_msgs/msg/int32.h>

#include <stdbool.h>
#include <stdint.h>

enum { EXECUTORS = 2, TOPICS = 2, TIMERS = 2, CONDITIONS = 2, ROUNDS = 4000, NOWHERE = -1 };
enum { FIRST, SECOND, SERVER, CLIENT, TIMER, CONDITION = TIMER + TIMERS, HANDLES = CONDITION + CONDITIONS };
enum { ADD, REMOVE, PUBLISH, ASK, TRIGGER, CANCEL, PERIOD, ACTIONS };
enum { TRIGGERS_EVERY_MS = 2 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executors[EXECUTORS];
static rcl_publisher_t publishers[TOPICS];
static rcl_subscription_t subscriptions[TOPICS];
static rcl_service_t server;
static rcl_client_t client;
static rcl_timer_t timers[TIMERS];
static rcl_guard_condition_t conditions[CONDITIONS];
static std_msgs__msg__Int32 taken[TOPICS];
static example_interfaces__srv__AddTwoInts_Request asked;
static example_interfaces__srv__AddTwoInts_Response answer;
static example_interfaces__srv__AddTwoInts_Response answered;
static int places[HANDLES]; /* the executor of each handle */
static uint32_t calls[HANDLES];
static int running = NOWHERE;
static uint32_t chance = 1;

/* The clock of the board, in place of that of the port. */
static volatile uint32_t now_ms = UINT32_MAX - 100u;
static volatile bool triggers;

void port_bare_tick(void);

void port_bare_tick(void)
{
  now_ms = now_ms + 1u;
  if (triggers && now_ms % (uint32_t)TRIGGERS_EVERY_MS == 0u) {
    (void)rcl_trigger_guard_condition(&conditions[0]);
  }
}

uint32_t port_time_ms(void)
{
  return now_ms;
}

/* Returns a number below `limit`. */
static uint32_t draw(uint32_t limit)
{
  chance = chance * 1664525u + 1013904223u;
  return (chance >> 8) % limit;
}

static void change(void);

static void called(int handle)
{
  check(places[handle] == running, 10u + (uint32_t)handle);
  ++calls[handle];
  if (draw(3) == 0u) {
    change();
  }
}

static void on_first(const void * message)
{
  (void)message;
  called(FIRST);
}

static void on_second(const void * message, void * context)
{
  check(context == &places[SECOND] && message == &taken[1], 3);
  called(SECOND);
}

static void on_request(const void * request, void * response)
{
  const example_interfaces__srv__AddTwoInts_Request * numbers = request;

  ((example_interfaces__srv__AddTwoInts_Response *)response)->sum = numbers->a + numbers->b;
  called(SERVER);
}

static void on_response(const void * response)
{
  check(((const example_interfaces__srv__AddTwoInts_Response *)response)->sum == 3, 4);
  called(CLIENT);
}

static void on_timer(rcl_timer_t * timer, int64_t last_call_time)
{
  (void)last_call_time;
  called(TIMER + (int)(timer - timers));
}

static void on_condition(void)
{
  called(CONDITION);
}

static void on_other_condition(void)
{
  called(CONDITION + 1);
}

static rcl_ret_t add(int handle, rclc_executor_t * executor)
{
  switch (handle) {
    case FIRST:
      return rclc_executor_add_subscription(executor, &subscriptions[0], &taken[0], on_first, ON_NEW_DATA);
    case SECOND:
      return rclc_executor_add_subscription_with_context(
        executor, &subscriptions[1], &taken[1], on_second, &places[SECOND], ON_NEW_DATA);
    case SERVER:
      return rclc_executor_add_service(executor, &server, &asked, &answer, on_request);
    case CLIENT:
      return rclc_executor_add_client(executor, &client, &answered, on_response);
    case CONDITION:
      return rclc_executor_add_guard_condition(executor, &conditions[0], on_condition);
    case CONDITION + 1:
      return rclc_executor_add_guard_condition(executor, &conditions[1], on_other_condition);
    default:
      return rclc_executor_add_timer(executor, &timers[handle - TIMER]);
  }
}

static rcl_ret_t take_out(int handle, rclc_executor_t * executor)
{
  switch (handle) {
    case FIRST:
    case SECOND:
      return rclc_executor_remove_subscription(executor, &subscriptions[handle]);
    case SERVER:
      return rclc_executor_remove_service(executor, &server);
    case CLIENT:
      return rclc_executor_remove_client(executor, &client);
    case CONDITION:
    case CONDITION + 1:
      return rclc_executor_remove_guard_condition(executor, &conditions[handle - CONDITION]);
    default:
      return rclc_executor_remove_timer(executor, &timers[handle - TIMER]);
  }
}

static void publish(void)
{
  const std_msgs__msg__Int32 message = {.data = 1};

  check(rcl_publish(&publishers[draw(TOPICS)], &message, NULL) == RCL_RET_OK, 5);
}

/* A queue that is full refuses the request. */
static void ask(void)
{
  const example_interfaces__srv__AddTwoInts_Request request = {.a = 1, .b = 2};
  int64_t number = 0;

  (void)rcl_send_request(&client, &request, &number);
}

static void cancel(rcl_timer_t * timer)
{
  bool is_canceled = false;

  check(rcl_timer_is_canceled(timer, &is_canceled) == RCL_RET_OK, 6);
  check((is_canceled ? rcl_timer_reset(timer) : rcl_timer_cancel(timer)) == RCL_RET_OK, 6);
}

static void change(void)
{
  const int handle = (int)draw(HANDLES);
  const int executor = places[handle];
  rcl_timer_t * timer = &timers[draw(TIMERS)];
  int64_t before = 0;

  switch (draw(ACTIONS)) {
    case ADD:
      if (executor == NOWHERE) {
        places[handle] = (int)draw(EXECUTORS);
        check(add(handle, &executors[places[handle]]) == RCL_RET_OK, 7);
      }
      break;
    case REMOVE:
      places[handle] = NOWHERE;
      check(
        (take_out(handle, &executors[executor == NOWHERE ? 0 : executor]) == RCL_RET_OK) ==
          (executor != NOWHERE),
        8);
      break;
    case PUBLISH:
      publish();
      break;
    case ASK:
      ask();
      break;
    case TRIGGER:
      check(rcl_trigger_guard_condition(&conditions[1]) == RCL_RET_OK, 9);
      break;
    case CANCEL:
      cancel(timer);
      break;
    default:
      check(rcl_timer_exchange_period(timer, RCL_MS_TO_NS((int64_t)draw(4)), &before) == RCL_RET_OK, 6);
      break;
  }
}

static void open_all(void)
{
  static const char * const topics[TOPICS] = {"first", "second"};
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const rosidl_service_type_support_t * sum =
    ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK, 2);
  check(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK, 2);
  check(rclc_service_init_default(&server, &node, sum, "sum") == RCL_RET_OK, 2);
  check(rclc_client_init_default(&client, &node, sum, "sum") == RCL_RET_OK, 2);
  for (size_t i = 0; i < (size_t)TOPICS; ++i) {
    check(rclc_publisher_init_default(&publishers[i], &node, type, topics[i]) == RCL_RET_OK, 2);
    check(rclc_subscription_init_default(&subscriptions[i], &node, type, topics[i]) == RCL_RET_OK, 2);
  }
  for (size_t i = 0; i < (size_t)EXECUTORS; ++i) {
    check(rclc_executor_init(&executors[i], &support.context, HANDLES, &allocator) == RCL_RET_OK, 2);
  }
  for (size_t i = 0; i < (size_t)TIMERS; ++i) {
    check(
      rclc_timer_init_default2(&timers[i], &support, RCL_MS_TO_NS((int64_t)i), on_timer, true) == RCL_RET_OK,
      2);
  }
  for (size_t i = 0; i < (size_t)CONDITIONS; ++i) {
    conditions[i] = rcl_get_zero_initialized_guard_condition();
    check(
      rcl_guard_condition_init(&conditions[i], &support.context, rcl_guard_condition_get_default_options()) ==
        RCL_RET_OK,
      2);
  }
}

/* Runs a round of one of the executors, with semantics and a trigger that chance decides. */
static void run_round(void)
{
  rclc_executor_t * executor;

  running = (int)draw(EXECUTORS);
  executor = &executors[running];
  check(
    rclc_executor_set_semantics(
      executor, draw(2) != 0u ? RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME : RCLC_SEMANTICS_RCLCPP_EXECUTOR) ==
      RCL_RET_OK,
    20);
  check(
    rclc_executor_set_trigger(
      executor, draw(2) != 0u ? rclc_executor_trigger_any : rclc_executor_trigger_always, NULL) == RCL_RET_OK,
    20);
  if (draw(40) == 0u) {
    executor->invocation_time = 0;
    check(rclc_executor_set_timeout(executor, 0) == RCL_RET_OK, 21);
    check(rclc_executor_spin_one_period(executor, RCL_MS_TO_NS(1)) == RCL_RET_OK, 21);
  } else {
    check(rclc_executor_spin_some(executor, 0) == RCL_RET_OK, 22);
  }
  running = NOWHERE;
}

int main(void)
{
  open_all();
  for (int handle = 0; handle < HANDLES; ++handle) {
    places[handle] = NOWHERE;
  }
  triggers = true;
  for (uint32_t i = 0; i < (uint32_t)ROUNDS; ++i) {
    change();
    change();
    run_round();
  }
  for (int handle = 0; handle < HANDLES; ++handle) {
    check(calls[handle] > 20u, 30u + (uint32_t)handle);
  }
  check(now_ms < UINT32_MAX / 2u, 40);
  end(0);
}
