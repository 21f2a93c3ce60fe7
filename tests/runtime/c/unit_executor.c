/* SPDX-License-Identifier: Apache-2.0 */
/* The executor over timers, subscriptions and guard conditions: 2 executors of 5 handles. */
#include "microros/rcl_waiting.h"
#include "port_agent.h"
#include "types.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <string.h>

enum { NOTES = 32, FIRST_READER = 3 };

static const int64_t ms = 1000000;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_subscription_t subscriptions[2];
static std_msgs__msg__Int32 numbers[2];
static rcl_guard_condition_t guard;
static rclc_executor_t executor;
static char notes[NOTES];
static int32_t heard;
static int context_value;

/* What happened, a letter each, since the last time this was asked. */
static bool noted(const char * expected)
{
  const bool same = strcmp(notes, expected) == 0;

  if (!same) {
    (void)fprintf(stderr, "noted '%s', expected '%s'\n", notes, expected);
  }
  memset(notes, 0, sizeof(notes));
  return same;
}

static void note(char letter)
{
  notes[strlen(notes)] = letter;
}

static void on_timer(rcl_timer_t * timer, int64_t last_call_time)
{
  (void)timer;
  (void)last_call_time;
  note('t');
}

static void on_first(const void * message)
{
  const std_msgs__msg__Int32 * number = message;

  note(number != NULL ? 'a' : '0');
  if (number != NULL) {
    heard = number->data;
  }
}

static void on_second(const void * message, void * context)
{
  CHECK(context == &context_value);
  note(message != NULL ? 'b' : '1');
}

static void on_guard(void)
{
  note('g');
}

static void trigger_guard(void)
{
  CHECK(rcl_trigger_guard_condition(&guard) == RCL_RET_OK);
}

static void begin(void)
{
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  (void)noted("");
}

static void add_both(rclc_executor_handle_invocation_t invocation)
{
  CHECK(
    rclc_executor_add_subscription(&executor, &subscriptions[0], &numbers[0], on_first, invocation) ==
    RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription_with_context(
      &executor, &subscriptions[1], &numbers[1], on_second, &context_value, invocation) == RCL_RET_OK);
}

static void end(void)
{
  CHECK(rclc_executor_fini(&executor) == RCL_RET_OK);
}

static rcl_timer_t timer_of(int64_t period)
{
  rcl_timer_t timer;

  CHECK(rclc_timer_init_default2(&timer, &support, (uint64_t)period, on_timer, true) == RCL_RET_OK);
  return timer;
}

static rcl_ret_t spin(int64_t timeout)
{
  return rclc_executor_spin_some(&executor, (uint64_t)timeout);
}

static void test_arguments(void)
{
  rclc_executor_t fresh = rclc_executor_get_zero_initialized_executor();
  rclc_executor_t others[2];

  CHECK(rclc_executor_init(NULL, &support.context, 1, &allocator) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_init(&fresh, NULL, 1, &allocator) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_init(&fresh, &support.context, 0, &allocator) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_init(&fresh, &support.context, 1, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(
    rclc_executor_set_timeout(&fresh, 1) == RCL_RET_ERROR &&
    rclc_executor_spin_some(&fresh, 0) == RCL_RET_ERROR);
  CHECK(rclc_executor_add_guard_condition(&fresh, &guard, on_guard) == RCL_RET_ERROR);
  CHECK(rclc_executor_fini(&fresh) == RCL_RET_OK && rclc_executor_prepare(NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_spin(NULL) == RCL_RET_INVALID_ARGUMENT);
  begin();
  CHECK(executor.timeout_ns == 1000000000u && executor.max_handles == 5u);
  CHECK(rclc_executor_add_timer(&executor, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_add_guard_condition(&executor, &guard, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_init(&others[0], &support.context, 99, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_init(&others[0], &support.context, 1, &allocator) == RCL_RET_OK); /* again */
  CHECK(rclc_executor_init(&others[1], &support.context, 1, &allocator) == RCL_RET_BAD_ALLOC);
  CHECK(strstr(rcl_get_error_string().str, "pools: {executors: 3}") != NULL);
  CHECK(rclc_executor_fini(&others[0]) == RCL_RET_OK && rclc_executor_fini(&others[0]) == RCL_RET_OK);
  end();
}

static void test_handles_are_counted(void)
{
  begin();
  for (int i = 0; i < 5; ++i) {
    CHECK(rclc_executor_add_guard_condition(&executor, &guard, on_guard) == RCL_RET_OK);
  }
  CHECK(executor.info.number_of_guard_conditions == 5u);
  CHECK(rclc_executor_add_guard_condition(&executor, &guard, on_guard) == RCL_RET_ERROR);
  CHECK(strstr(rcl_get_error_string().str, "pools: {handles: 6}") != NULL);
  CHECK(rclc_executor_remove_guard_condition(&executor, &guard) == RCL_RET_OK && executor.index == 4u);
  CHECK(rclc_executor_remove_subscription(&executor, &subscriptions[0]) == RCL_RET_ERROR);
  CHECK(rclc_executor_remove_guard_condition(&executor, NULL) == RCL_RET_INVALID_ARGUMENT);
  end();
}

/* Waiting is one long rest, not many short ones. */
static void test_waits_for_a_timer(void)
{
  rcl_timer_t timer = timer_of(300 * ms);
  const int64_t start = agent_now_ns;

  begin();
  CHECK(rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK);
  agent_waits = 0;
  CHECK(spin(100 * ms) == RCL_RET_OK && noted("") && agent_now_ns == start + 100 * ms);
  CHECK(spin(1000 * ms) == RCL_RET_OK && noted("t") && agent_now_ns == start + 300 * ms);
  CHECK(spin(0) == RCL_RET_OK && noted("") && agent_now_ns == start + 300 * ms);
  CHECK(agent_waits < 30u); /* GET_INFO of the liveliness check every 100 ms */
  CHECK(rcl_timer_cancel(&timer) == RCL_RET_OK);
  CHECK(spin(700 * ms) == RCL_RET_OK && noted("") && agent_now_ns == start + 1000 * ms);
  CHECK(rclc_executor_remove_timer(&executor, &timer) == RCL_RET_OK);
  CHECK(
    spin(50 * ms) == RCL_RET_OK && agent_now_ns == start + 1050 * ms); /* nothing to run: it rests as well */
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
  end();
}

/* Nanoseconds to milliseconds, rounded up, without a division of 64 bits: against one. */
/* For an application that sleeps itself. unit_wakes.c counts how often it wakes. */
static void test_the_executor_says_when_it_is_due(void)
{
  rcl_timer_t timer = timer_of(10 * ms);
  int64_t due_ns = -1;

  CHECK(rclc_executor_time_until_due(NULL, &due_ns) == RCL_RET_INVALID_ARGUMENT);
  rcl_reset_error();
  CHECK(rclc_executor_time_until_due(&executor, &due_ns) == RCL_RET_ERROR && due_ns == -1);
  rcl_reset_error();
  begin();
  CHECK(rclc_executor_time_until_due(&executor, NULL) == RCL_RET_INVALID_ARGUMENT);
  rcl_reset_error();
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  CHECK(rclc_executor_time_until_due(&executor, &due_ns) == RCL_RET_OK && due_ns > 20 * ms); /* the session */
  CHECK(rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK);
  CHECK(rclc_executor_add_guard_condition(&executor, &guard, on_guard) == RCL_RET_OK);
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK && noted(""));
  CHECK(rclc_executor_time_until_due(&executor, &due_ns) == RCL_RET_OK && due_ns == 10 * ms);
  agent_now_ns += 4 * ms + 1;
  CHECK(rclc_executor_time_until_due(&executor, &due_ns) == RCL_RET_OK && due_ns == 6 * ms - 1);
  trigger_guard();
  CHECK(rclc_executor_time_until_due(&executor, &due_ns) == RCL_RET_OK && due_ns == 0);
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK && noted("g"));
  CHECK(rclc_executor_time_until_due(&executor, &due_ns) == RCL_RET_OK && due_ns == 6 * ms - 1);
  agent_now_ns += 6 * ms;
  CHECK(rclc_executor_time_until_due(&executor, &due_ns) == RCL_RET_OK && due_ns == 0);
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK && noted("t"));
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
  CHECK(rclc_executor_time_until_due(&executor, &due_ns) != RCL_RET_OK); /* the round says the same */
  rcl_reset_error();
  end();
}

static void test_times_are_rounded_up(void)
{
  const int64_t longest = (int64_t)(UINT32_MAX - 1u) * ms;

  for (int64_t near = 1; near <= longest; near = near * 3 + 1) {
    for (int64_t around = -2; around <= 2; ++around) {
      const int64_t whole = near / ms * ms + around; /* about a whole number */
      const int64_t odd = near + around;

      CHECK(whole < 0 || rcl_waiting_begin(whole).timeout_ms == (uint32_t)((whole + ms - 1) / ms));
      CHECK(odd < 0 || rcl_waiting_begin(odd).timeout_ms == (uint32_t)((odd + ms - 1) / ms));
    }
  }
  CHECK(rcl_waiting_begin(0).timeout_ms == 0u && rcl_waiting_begin(-1).timeout_ms == UINT32_MAX);
  CHECK(rcl_waiting_begin(longest - ms).timeout_ms == UINT32_MAX - 2u);
  CHECK(rcl_waiting_begin(longest).timeout_ms == UINT32_MAX - 1u);
  CHECK(rcl_waiting_begin(longest + 1).timeout_ms == UINT32_MAX);
  CHECK(rcl_waiting_begin(INT64_MAX).timeout_ms == UINT32_MAX);
}

static void test_an_ended_entity_is_told(void)
{
  rcl_timer_t timer = timer_of(300 * ms);

  begin();
  CHECK(rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK && rcl_timer_fini(&timer) == RCL_RET_OK);
  CHECK(spin(0) == RCL_RET_TIMER_INVALID && rclc_executor_spin(&executor) == RCL_RET_TIMER_INVALID);
  end();
}

static void test_order_is_that_of_adding(void)
{
  rcl_timer_t timer = timer_of(10 * ms);

  begin();
  CHECK(rclc_executor_add_guard_condition(&executor, &guard, on_guard) == RCL_RET_OK);
  add_both(ON_NEW_DATA);
  CHECK(rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK);
  agent_offer_number(FIRST_READER + 1, 5);
  agent_offer_number(FIRST_READER, 4);
  agent_offer_number(FIRST_READER, 6);
  trigger_guard();
  agent_now_ns += 10 * ms;
  CHECK(spin(1000 * ms) == RCL_RET_OK && noted("gabt") && heard == 4); /* one sample a round */
  CHECK(spin(1000 * ms) == RCL_RET_OK && noted("a") && heard == 6);
  CHECK(spin(0) == RCL_RET_OK && noted(""));
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
  end();
}

static void test_always(void)
{
  begin();
  add_both(ALWAYS);
  agent_offer_number(FIRST_READER, 1);
  CHECK(spin(1000 * ms) == RCL_RET_OK && noted("a1"));
  CHECK(spin(5 * ms) == RCL_RET_OK && noted("")); /* trigger_any */
  CHECK(rclc_executor_set_trigger(&executor, rclc_executor_trigger_always, NULL) == RCL_RET_OK);
  CHECK(spin(5 * ms) == RCL_RET_OK && noted("01"));
  end();
}

static void test_triggers(void)
{
  begin();
  add_both(ON_NEW_DATA);
  CHECK(rclc_executor_set_trigger(&executor, rclc_executor_trigger_all, NULL) == RCL_RET_OK);
  agent_offer_number(FIRST_READER, 1);
  CHECK(spin(1000 * ms) == RCL_RET_OK && noted(""));
  agent_waits = 0;
  CHECK(
    spin(1000 * ms) == RCL_RET_OK && noted("") &&
    agent_waits < 40u); /* what is ready alone does not keep it busy */
  agent_offer_number(FIRST_READER + 1, 2);
  CHECK(spin(1000 * ms) == RCL_RET_OK && noted("ab"));
  CHECK(rclc_executor_set_trigger(&executor, rclc_executor_trigger_one, &subscriptions[1]) == RCL_RET_OK);
  agent_offer_number(FIRST_READER, 1);
  CHECK(spin(20 * ms) == RCL_RET_OK && noted(""));
  agent_offer_number(FIRST_READER + 1, 2);
  CHECK(spin(20 * ms) == RCL_RET_OK && noted("ab"));
  CHECK(rclc_executor_set_trigger(&executor, NULL, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(!rclc_executor_trigger_any(NULL, 1, NULL) && !rclc_executor_trigger_all(NULL, 1, NULL));
  end();
}

/* A sample that comes while the first callback runs. */
static void offer_late(rcl_timer_t * timer, int64_t last_call_time)
{
  on_timer(timer, last_call_time);
  agent_offer_number(FIRST_READER, numbers[0].data + 1);
  (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
}

/* In logical execution time all is read before the first callback. */
static void test_semantics(void)
{
  rcl_timer_t timer;

  CHECK(rclc_timer_init_default2(&timer, &support, (uint64_t)(10 * ms), offer_late, true) == RCL_RET_OK);
  begin();
  CHECK(rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK);
  add_both(ON_NEW_DATA);
  CHECK(rclc_executor_set_semantics(&executor, RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME) == RCL_RET_OK);
  agent_offer_number(FIRST_READER, 10);
  agent_now_ns += 10 * ms;
  CHECK(spin(0) == RCL_RET_OK && noted("ta") && heard == 10);
  CHECK(spin(0) == RCL_RET_OK && noted("a") && heard == 11);
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
  end();
}

/* Too short for an Int32: told, and the others are not affected. */
static void test_a_sample_that_is_none(void)
{
  static const uint8_t body[2] = {1, 2};

  begin();
  add_both(ON_NEW_DATA);
  agent_offer(FIRST_READER, body, sizeof(body));
  agent_offer_number(FIRST_READER + 1, 2);
  CHECK(spin(20 * ms) == RCL_RET_ERROR && noted("b"));
  CHECK(strstr(rcl_get_error_string().str, "Int32") != NULL);
  agent_offer_number(FIRST_READER, 3);
  CHECK(spin(20 * ms) == RCL_RET_OK && noted("a") && heard == 3);
  end();
}

static void test_a_guard_condition_wakes(void)
{
  const int64_t start = agent_now_ns;
  rcl_guard_condition_t others[2] = {
    rcl_get_zero_initialized_guard_condition(), rcl_get_zero_initialized_guard_condition()};
  const rcl_guard_condition_options_t options = rcl_guard_condition_get_default_options();

  begin();
  CHECK(rclc_executor_add_guard_condition(&executor, &guard, on_guard) == RCL_RET_OK);
  agent_event_ns = start + 7 * ms;
  agent_event = trigger_guard;
  CHECK(spin(1000 * ms) == RCL_RET_OK && noted("g") && agent_now_ns == start + 7 * ms);
  CHECK(spin(3 * ms) == RCL_RET_OK && noted(""));
  CHECK(rcl_guard_condition_init(&others[0], &support.context, options) == RCL_RET_OK);
  CHECK(rcl_guard_condition_init(&others[0], &support.context, options) == RCL_RET_ALREADY_INIT);
  CHECK(rcl_guard_condition_init(&others[1], &support.context, options) == RCL_RET_BAD_ALLOC);
  CHECK(rcl_guard_condition_fini(&others[0]) == RCL_RET_OK);
  CHECK(rcl_trigger_guard_condition(&others[0]) == RCL_RET_INVALID_ARGUMENT);
  end();
}

/* ROS time that stands still does not end a wait; its jump does. */
static rcl_clock_t ros_clock;

static void jump(void)
{
  CHECK(rcl_set_ros_time_override(&ros_clock, 500 * ms) == RCL_RET_OK);
}

static void test_ros_time(void)
{
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  const int64_t start = agent_now_ns;

  CHECK(rcl_clock_init(RCL_ROS_TIME, &ros_clock, &allocator) == RCL_RET_OK);
  CHECK(rcl_set_ros_time_override(&ros_clock, 1) == RCL_RET_OK);
  CHECK(rcl_enable_ros_time_override(&ros_clock) == RCL_RET_OK);
  CHECK(
    rcl_timer_init2(&timer, &ros_clock, &support.context, 100 * ms, on_timer, allocator, true) == RCL_RET_OK);
  begin();
  CHECK(rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK);
  CHECK(spin(300 * ms) == RCL_RET_OK && noted("") && agent_now_ns == start + 300 * ms);
  agent_event_ns = agent_now_ns + 20 * ms;
  agent_event = jump;
  CHECK(spin(300 * ms) == RCL_RET_OK && noted("t") && agent_now_ns == start + 320 * ms);
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK && rcl_clock_fini(&ros_clock) == RCL_RET_OK);
  end();
}

/* Four periods of 25 ms; the third round takes longer than that, and the fourth begins at once. */
static void test_spin_one_period(void)
{
  rcl_timer_t timer = timer_of(1 * ms);
  const int64_t start = agent_now_ns;

  begin();
  CHECK(rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK);
  CHECK(rclc_executor_spin_one_period(&executor, (uint64_t)(25 * ms)) == RCL_RET_OK);
  CHECK(noted("t") && agent_now_ns == start + 25 * ms);
  CHECK(rclc_executor_spin_one_period(&executor, (uint64_t)(25 * ms)) == RCL_RET_OK);
  CHECK(noted("t") && agent_now_ns == start + 50 * ms);
  agent_now_ns += 30 * ms;
  CHECK(rclc_executor_spin_one_period(&executor, (uint64_t)(25 * ms)) == RCL_RET_OK);
  CHECK(noted("t") && agent_now_ns == start + 80 * ms);
  CHECK(rclc_executor_spin_one_period(&executor, (uint64_t)(25 * ms)) == RCL_RET_OK);
  CHECK(noted("t") && agent_now_ns == start + 100 * ms);
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
  end();
}

static void stop(rcl_timer_t * timer, int64_t last_call_time)
{
  on_timer(timer, last_call_time);
  if (strlen(notes) == 3u) {
    CHECK(rclc_support_fini(&support) == RCL_RET_OK);
  }
}

static void test_wait_set(void)
{
  rcl_wait_set_t set = rcl_get_zero_initialized_wait_set();
  rcl_wait_set_t other = rcl_get_zero_initialized_wait_set();
  rcl_timer_t timer = timer_of(40 * ms);
  const int64_t start = agent_now_ns;
  size_t index = 9;

  CHECK(
    rcl_wait(&set, 0) == RCL_RET_WAIT_SET_INVALID && rcl_wait_set_clear(&set) == RCL_RET_WAIT_SET_INVALID);
  CHECK(rcl_wait_set_init(&set, 3, 0, 0, 0, 0, 0, &support.context, allocator) == RCL_RET_BAD_ALLOC);
  CHECK(strstr(rcl_get_error_string().str, "pools: {subscriptions: 3}") != NULL);
  CHECK(rcl_wait_set_init(&set, 250, 0, 0, 0, 0, 0, &support.context, allocator) == RCL_RET_BAD_ALLOC);
  CHECK(strstr(rcl_get_error_string().str, "pools: {subscriptions: 250}") != NULL);
  CHECK(rcl_wait_set_init(&set, 251, 0, 0, 0, 0, 0, &support.context, allocator) == RCL_RET_BAD_ALLOC);
  CHECK(strstr(rcl_get_error_string().str, "pools") == NULL); /* nothing helps */
  CHECK(rcl_wait_set_init(&set, 0, 0, 0, 0, 0, 1, &support.context, allocator) == RCL_RET_BAD_ALLOC);
  CHECK(rcl_wait_set_init(&set, 0, 0, 0, 0, 0, 0, &support.context, allocator) == RCL_RET_OK);
  CHECK(rcl_wait(&set, 0) == RCL_RET_WAIT_SET_EMPTY);
  CHECK(rcl_wait_set_init(&other, 1, 0, 0, 0, 0, 0, &support.context, allocator) == RCL_RET_BAD_ALLOC);
  CHECK(rcl_wait_set_resize(&set, 2, 1, 1, 0, 0, 0) == RCL_RET_OK && set.size_of_subscriptions == 2u);
  CHECK(rcl_wait_set_add_subscription(&set, &subscriptions[0], NULL) == RCL_RET_OK);
  CHECK(rcl_wait_set_add_subscription(&set, &subscriptions[1], &index) == RCL_RET_OK && index == 1u);
  CHECK(rcl_wait_set_add_subscription(&set, &subscriptions[1], &index) == RCL_RET_WAIT_SET_FULL);
  CHECK(rcl_wait_set_add_guard_condition(&set, &guard, NULL) == RCL_RET_OK);
  CHECK(rcl_wait_set_add_timer(&set, &timer, NULL) == RCL_RET_OK);
  CHECK(rcl_wait(&set, 10 * ms) == RCL_RET_TIMEOUT && agent_now_ns == start + 10 * ms);
  CHECK(set.subscriptions[0] == NULL && set.timers[0] == NULL && set.guard_conditions[0] == NULL);
  CHECK(rcl_wait_set_clear(&set) == RCL_RET_OK && rcl_wait_set_add_timer(&set, &timer, NULL) == RCL_RET_OK);
  CHECK(rcl_wait(&set, -1) == RCL_RET_OK && agent_now_ns == start + 40 * ms && set.timers[0] == &timer);
  CHECK(rcl_timer_cancel(&timer) == RCL_RET_OK && rcl_wait_set_clear(&set) == RCL_RET_OK);
  CHECK(rcl_wait_set_add_subscription(&set, &subscriptions[0], NULL) == RCL_RET_OK);
  CHECK(rcl_wait_set_add_guard_condition(&set, &guard, NULL) == RCL_RET_OK);
  agent_offer_number(FIRST_READER, 8);
  trigger_guard();
  CHECK(rcl_wait(&set, 10 * ms) == RCL_RET_OK);
  CHECK(set.subscriptions[0] == &subscriptions[0] && set.guard_conditions[0] == &guard);
  CHECK(rcl_take(&subscriptions[0], &numbers[0], NULL, NULL) == RCL_RET_OK && numbers[0].data == 8);
  CHECK(rcl_wait(&set, 10 * ms) == RCL_RET_TIMEOUT); /* a guard condition is seen once */
  CHECK(rcl_wait_set_fini(&set) == RCL_RET_OK && !rcl_wait_set_is_valid(&set));
  CHECK(rcl_wait_set_fini(&set) == RCL_RET_OK && rcl_timer_fini(&timer) == RCL_RET_OK);
}

/* rclc_executor_spin ends with its context. */
static void test_spin(void)
{
  rcl_timer_t timer;

  CHECK(rclc_timer_init_default2(&timer, &support, (uint64_t)(10 * ms), stop, true) == RCL_RET_OK);
  begin();
  CHECK(rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK);
  CHECK(rclc_executor_spin(&executor) == RCL_RET_ERROR && noted("ttt"));
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
  end();
}

int main(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);

  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "runner", "", &support) == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&subscriptions[0], &node, type, "first") == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&subscriptions[1], &node, type, "second") == RCL_RET_OK);
  guard = rcl_get_zero_initialized_guard_condition();
  CHECK(
    rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()) ==
    RCL_RET_OK);
  for (int i = 0; i < 4; ++i) {
    (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)); /* until READ_DATA is out */
  }
  test_arguments();
  test_handles_are_counted();
  test_waits_for_a_timer();
  test_the_executor_says_when_it_is_due();
  test_times_are_rounded_up();
  test_an_ended_entity_is_told();
  test_order_is_that_of_adding();
  test_always();
  test_triggers();
  test_semantics();
  test_a_sample_that_is_none();
  test_a_guard_condition_wakes();
  test_ros_time();
  test_spin_one_period();
  test_wait_set();
  test_spin();
  return 0;
}
