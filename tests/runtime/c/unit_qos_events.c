/* SPDX-License-Identifier: Apache-2.0 */
/* Missed deadlines, counted as rclpy's are: not before the first message, once a period, from the last message on. */
#include "microros/rcl_event_places.h"
#include "port_agent.h"
#include "types.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/event.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <string.h>

enum { READERS_AT = 3 };

static const int64_t ms = 1000000;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_publisher_t free_publisher; /* without a deadline */
static rcl_subscription_t subscription;
static rcl_event_t offered;
static rcl_event_t requested;
static rclc_executor_t executor;
static std_msgs__msg__Int32 message;
static size_t told;

static void on_missed(const void * user_data, size_t number_of_events)
{
  CHECK(user_data == &told && number_of_events != 0u);
  told += number_of_events;
}

static void on_message(const void * received)
{
  (void)received;
}

static void publish(rcl_publisher_t * which)
{
  CHECK(rcl_publish(which, &message, NULL) == RCL_RET_OK);
}

static void offer(void)
{
  agent_offer_number(READERS_AT, 1);
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
}

static void spin(int64_t milliseconds)
{
  agent_waits = 0;
  CHECK(rclc_executor_spin_some(&executor, (uint64_t)(milliseconds * ms)) == RCL_RET_OK);
}

/* Takes both events: totals and changes of the publisher's and of the subscription's. */
static bool missed(int32_t of_publisher, int32_t change, int32_t of_subscription, int32_t other_change)
{
  rmw_offered_deadline_missed_status_t first;
  rmw_requested_deadline_missed_status_t second;

  CHECK(rcl_take_event(&offered, &first) == RCL_RET_OK && rcl_take_event(&requested, &second) == RCL_RET_OK);
  if (first.total_count != of_publisher || second.total_count != of_subscription) {
    (void)fprintf(stderr, "%d %d\n", (int)first.total_count, (int)second.total_count);
  }
  return first.total_count == of_publisher && first.total_count_change == change &&
         second.total_count == of_subscription && second.total_count_change == other_change;
}

/* The codes are those of librcl; what XRCE does not carry is refused by name. */
static void test_arguments(void)
{
  rcl_event_t event = rcl_get_zero_initialized_event();
  rcl_publisher_t none = rcl_get_zero_initialized_publisher();
  const rcl_publisher_event_type_t refused[] = {
    RCL_PUBLISHER_LIVELINESS_LOST, RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS, RCL_PUBLISHER_INCOMPATIBLE_TYPE,
    RCL_PUBLISHER_MATCHED};

  CHECK(
    rcl_publisher_event_init(NULL, &publisher, RCL_PUBLISHER_OFFERED_DEADLINE_MISSED) ==
    RCL_RET_EVENT_INVALID);
  CHECK(
    rcl_publisher_event_init(&event, NULL, RCL_PUBLISHER_OFFERED_DEADLINE_MISSED) ==
    RCL_RET_INVALID_ARGUMENT);
  CHECK(
    rcl_publisher_event_init(&event, &none, RCL_PUBLISHER_OFFERED_DEADLINE_MISSED) ==
    RCL_RET_INVALID_ARGUMENT);
  for (size_t i = 0; i < sizeof(refused) / sizeof(refused[0]); ++i) {
    CHECK(rcl_publisher_event_init(&event, &publisher, refused[i]) == RCL_RET_UNSUPPORTED);
    CHECK(i != 0u || strstr(rcl_get_error_string().str, "liveliness: XRCE carries none") != NULL);
    CHECK(
      i % 2u == 0u || i > 3u ||
      strstr(rcl_get_error_string().str, "XRCE reports none: add component graph_events") != NULL);
    rcl_reset_error();
  }
  CHECK(
    rcl_subscription_event_init(&event, &subscription, RCL_SUBSCRIPTION_LIVELINESS_CHANGED) ==
    RCL_RET_UNSUPPORTED);
  CHECK(!rcl_event_is_valid(NULL) && !rcl_event_is_valid(&event));
  CHECK(rcl_event_fini(NULL) == RCL_RET_EVENT_INVALID && rcl_event_fini(&event) == RCL_RET_OK);
  CHECK(rcl_take_event(NULL, NULL) == RCL_RET_EVENT_INVALID);
  CHECK(rcl_take_event(&event, NULL) == RCL_RET_EVENT_INVALID);
  CHECK(rcl_event_set_callback(NULL, on_missed, &told) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_event_set_callback(&event, on_missed, &told) == RCL_RET_INVALID_ARGUMENT);
}

static void open_events(void)
{
  rcl_event_t second = rcl_get_zero_initialized_event();

  offered = rcl_get_zero_initialized_event();
  requested = rcl_get_zero_initialized_event();
  CHECK(rcl_publisher_event_init(&offered, &publisher, RCL_PUBLISHER_OFFERED_DEADLINE_MISSED) == RCL_RET_OK);
  CHECK(
    rcl_publisher_event_init(&offered, &publisher, RCL_PUBLISHER_OFFERED_DEADLINE_MISSED) ==
    RCL_RET_ALREADY_INIT);
  CHECK(
    rcl_publisher_event_init(&second, &publisher, RCL_PUBLISHER_OFFERED_DEADLINE_MISSED) ==
    RCL_RET_ALREADY_INIT);
  CHECK(
    rcl_subscription_event_init(&requested, &subscription, RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED) ==
    RCL_RET_OK);
  CHECK(rcl_event_is_valid(&offered) && rcl_take_event(&offered, NULL) == RCL_RET_INVALID_ARGUMENT);
}

/* The calls of a run of rclpy with a deadline of 200 ms, and its counts. The milliseconds wrap meanwhile. */
static void test_counts(void)
{
  spin(1000);
  CHECK(missed(0, 0, 0, 0)); /* nothing published yet */
  publish(&publisher);
  offer();
  spin(700);
  CHECK(missed(3, 3, 3, 3));
  publish(&publisher);
  offer();
  spin(100);
  CHECK(missed(3, 0, 3, 0));
  publish(&publisher); /* in time */
  spin(150);
  CHECK(missed(3, 0, 4, 1));
  spin(300);
  CHECK(missed(5, 2, 5, 1));
  agent_now_ns += 700 * ms; /* the application does something else */
  CHECK(missed(8, 3, 9, 4));
}

/* A message that comes too late ends a period that was missed. */
static void test_a_late_message(void)
{
  publish(&publisher);
  offer();
  (void)missed(0, 0, 0, 0);
  agent_now_ns += 250 * ms;
  publish(&publisher);
  offer();
  CHECK(missed(9, 1, 10, 1));
  agent_now_ns += 199 * ms;
  CHECK(missed(9, 0, 10, 0));
  agent_now_ns += 1 * ms;
  CHECK(missed(10, 1, 11, 1));
}

static void test_callback(void)
{
  publish(&publisher);
  agent_now_ns += 400 * ms;
  spin(0);
  told = 0;
  CHECK(rcl_event_set_callback(&offered, on_missed, &told) == RCL_RET_OK && told == 2u); /* not taken yet */
  spin(1000); /* it ends the rest of the executor each time */
  CHECK(told == 7u);
  CHECK(rcl_event_set_callback(&offered, NULL, NULL) == RCL_RET_OK);
  spin(1000);
  CHECK(told == 7u);
}

/* A wait set has events until they are taken, and returns when a deadline is missed. */
static void test_wait_set(void)
{
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  rmw_offered_deadline_missed_status_t status;
  size_t index = 9;

  CHECK(rcl_wait_set_add_event(NULL, &offered, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_wait_set_add_event(&wait_set, &offered, NULL) == RCL_RET_WAIT_SET_INVALID);
  CHECK(
    rcl_wait_set_init(&wait_set, 0, 0, 0, 0, 0, RCL_WAIT_EVENTS_MAX + 1, &support.context, allocator) ==
    RCL_RET_BAD_ALLOC);
  CHECK(rcl_wait_set_init(&wait_set, 0, 0, 0, 0, 0, 2, &support.context, allocator) == RCL_RET_OK);
  CHECK(wait_set.size_of_events == 2u && wait_set.events[0] == NULL && wait_set.events[1] == NULL);
  CHECK(rcl_wait_set_add_event(&wait_set, NULL, NULL) == RCL_RET_INVALID_ARGUMENT);
  publish(&publisher);
  CHECK(rcl_take_event(&offered, &status) == RCL_RET_OK && rcl_take_event(&requested, &status) == RCL_RET_OK);
  offer(); /* its deadline begins later */
  CHECK(rcl_wait_set_add_event(&wait_set, &requested, NULL) == RCL_RET_OK);
  CHECK(rcl_wait_set_add_event(&wait_set, &offered, &index) == RCL_RET_OK && index == 1u);
  CHECK(rcl_wait_set_add_event(&wait_set, &offered, NULL) == RCL_RET_WAIT_SET_FULL);
  CHECK(rcl_wait(&wait_set, 50 * ms) == RCL_RET_TIMEOUT);
  CHECK(wait_set.events[0] == NULL && wait_set.events[1] == NULL);
  for (int i = 0; i < 2; ++i) { /* not taken meanwhile */
    CHECK(rcl_wait_set_clear(&wait_set) == RCL_RET_OK);
    CHECK(rcl_wait_set_add_event(&wait_set, &offered, &index) == RCL_RET_OK && index == 0u);
    CHECK(rcl_wait(&wait_set, 1000 * ms) == RCL_RET_OK && wait_set.events[0] == &offered);
  }
  CHECK(rcl_take_event(&offered, &status) == RCL_RET_OK && status.total_count_change == 1);
  CHECK(rcl_wait(&wait_set, 0) == RCL_RET_TIMEOUT && wait_set.events[0] == NULL);
  CHECK(rcl_wait_set_resize(&wait_set, 0, 0, 0, 0, 0, 0) == RCL_RET_OK && wait_set.events == NULL);
  CHECK(rcl_wait(&wait_set, 0) == RCL_RET_WAIT_SET_EMPTY && rcl_wait_set_fini(&wait_set) == RCL_RET_OK);
  (void)rcl_take_event(&requested, &status);
}

/* What the session loses was published all the same; what does not arrive is missed. */
static void test_a_lost_session(void)
{
  rmw_requested_deadline_missed_status_t status;

  offer();
  CHECK(rcl_take_event(&requested, &status) == RCL_RET_OK);
  agent_silent = true;
  for (int i = 0; i < 300; ++i) {
    spin(100);
  }
  CHECK(rcl_take_event(&requested, &status) == RCL_RET_OK && status.total_count_change == 150);
  agent_silent = false;
  for (int i = 0; i < 100; ++i) {
    spin(100);
  }
  CHECK(rcl_take_event(&requested, &status) == RCL_RET_OK && status.total_count_change == 50);
  offer();
  CHECK(rcl_take_event(&requested, &status) == RCL_RET_OK && status.total_count_change <= 1);
}

/* Without a deadline, and after the event or its entity ended, nothing is missed. */
static void test_ends(void)
{
  rcl_event_t event = rcl_get_zero_initialized_event();
  rmw_offered_deadline_missed_status_t status;
  rmw_offered_deadline_missed_status_t last;

  CHECK(
    rcl_publisher_event_init(&event, &free_publisher, RCL_PUBLISHER_OFFERED_DEADLINE_MISSED) == RCL_RET_OK);
  publish(&free_publisher);
  spin(1000);
  CHECK(rcl_take_event(&event, &status) == RCL_RET_OK && status.total_count == 0);
  CHECK(rcl_event_fini(&event) == RCL_RET_OK && !rcl_event_is_valid(&event));
  publish(&publisher);
  CHECK(rcl_take_event(&offered, &status) == RCL_RET_OK);
  CHECK(rcl_publisher_fini(&publisher, &node) == RCL_RET_OK);
  spin(1000);
  CHECK(rcl_take_event(&offered, &last) == RCL_RET_OK && last.total_count == status.total_count);
  CHECK(rcl_event_fini(&offered) == RCL_RET_OK && rcl_event_fini(&requested) == RCL_RET_OK);
}

int main(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rmw_qos_profile_t qos = rmw_qos_profile_sensor_data;

  qos.deadline.nsec = (uint64_t)(200 * ms);
  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "timely", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init(&publisher, &node, type, "out", &qos) == RCL_RET_OK);
  CHECK(rclc_publisher_init_best_effort(&free_publisher, &node, type, "free") == RCL_RET_OK);
  CHECK(rclc_subscription_init(&subscription, &node, type, "in", &qos) == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&executor, &subscription, &message, on_message, ON_NEW_DATA) ==
    RCL_RET_OK);
  spin(10);
  test_arguments();
  open_events();
  test_counts();
  test_a_late_message();
  test_callback();
  test_wait_set();
  test_a_lost_session();
  test_ends();
  return 0;
}
