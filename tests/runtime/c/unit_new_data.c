/* SPDX-License-Identifier: Apache-2.0 */
/* Callbacks for what arrives: how often, how many, in whose place, and what is never told. */
#include "port_agent.h"
#include "types.h"
#include "unit.h"
#include "unit_service.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <string.h>

enum { READERS_AT = 3, REPLIERS_AT = READERS_AT + 2, REQUESTERS_AT = REPLIERS_AT + 3 };

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_subscription_t subscriptions[2];
static rcl_service_t service;
static rcl_client_t client;
static rcl_guard_condition_t guard;
static rclc_executor_t executor;
static std_msgs__msg__Int32 message;
static int guarded;

/* What one callback was told. */
typedef struct told_t {
  uint32_t calls;
  size_t events;
} told_t;

static told_t told;
static told_t told_other;

static void on_new(const void * user_data, size_t number_of_events)
{
  told_t * mine = user_data == &told ? &told : &told_other;

  CHECK(user_data == &told || user_data == &told_other);
  CHECK(number_of_events != 0u);
  ++mine->calls;
  mine->events += number_of_events;
}

static void on_new_trigger(const void * user_data, size_t number_of_events)
{
  (void)user_data;
  (void)number_of_events;
  CHECK(rcl_trigger_guard_condition(&guard) == RCL_RET_OK);
}

static void on_guard(void)
{
  ++guarded;
}

static bool was_told(told_t * who, uint32_t calls, size_t events)
{
  const bool same = who->calls == calls && who->events == events;

  if (!same) {
    (void)fprintf(stderr, "%u calls, %u events\n", (unsigned)who->calls, (unsigned)who->events);
  }
  memset(who, 0, sizeof(*who));
  return same;
}

static void pump(void)
{
  for (int i = 0; i < 6; ++i) {
    CHECK(rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)) == RMW_RET_OK);
  }
}

static void offer(uint16_t role, int count)
{
  for (int i = 0; i < count; ++i) {
    agent_offer_number((uint16_t)(READERS_AT + role), i);
  }
  pump();
}

static rcl_ret_t set(size_t which, rcl_event_callback_t callback, const void * user_data)
{
  return rcl_subscription_set_on_new_message_callback(&subscriptions[which], callback, user_data);
}

static size_t take_all(size_t which)
{
  size_t count = 0;

  while (rcl_take(&subscriptions[which], &message, NULL, NULL) == RCL_RET_OK) {
    ++count;
  }
  return count;
}

/* The codes are those of librcl. */
static void test_arguments(void)
{
  rcl_subscription_t no_subscription = rcl_get_zero_initialized_subscription();
  rcl_service_t no_service = rcl_get_zero_initialized_service();
  rcl_client_t no_client = rcl_get_zero_initialized_client();

  CHECK(rcl_subscription_set_on_new_message_callback(NULL, on_new, &told) == RCL_RET_INVALID_ARGUMENT);
  CHECK(
    rcl_subscription_set_on_new_message_callback(&no_subscription, NULL, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_service_set_on_new_request_callback(NULL, on_new, &told) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_service_set_on_new_request_callback(&no_service, NULL, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_client_set_on_new_response_callback(NULL, on_new, &told) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_client_set_on_new_response_callback(&no_client, NULL, NULL) == RCL_RET_INVALID_ARGUMENT);
}

static void test_messages(void)
{
  CHECK(set(0, on_new, &told) == RCL_RET_OK);
  offer(0, 1);
  CHECK(was_told(&told, 1, 1));
  offer(1, 1); /* of the other subscription */
  CHECK(was_told(&told, 0, 0));
  offer(0, 3); /* two fit: the newer ones replace the older ones, and all have arrived */
  CHECK(was_told(&told, 3, 3) && take_all(0) == 2u);
  CHECK(set(0, NULL, NULL) == RCL_RET_OK);
  offer(0, 1);
  CHECK(was_told(&told, 0, 0));
}

/* One waits already. */
static void test_set_late(void)
{
  CHECK(set(0, on_new, &told) == RCL_RET_OK && was_told(&told, 1, 1));
  CHECK(set(0, on_new, &told_other) == RCL_RET_OK && was_told(&told_other, 1, 1) && was_told(&told, 0, 0));
  CHECK(take_all(0) == 1u && set(0, on_new, &told) == RCL_RET_OK && was_told(&told, 0, 0));
}

static void test_a_new_owner_is_not_told(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);

  CHECK(rcl_subscription_fini(&subscriptions[0], &node) == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&subscriptions[0], &node, type, "a") == RCL_RET_OK);
  pump();
  offer(0, 1);
  CHECK(take_all(0) == 1u && was_told(&told, 0, 0));
}

static void test_services(void)
{
  const std_msgs__msg__Int32 question = {7};
  rmw_request_id_t header;
  int64_t sequence = 0;

  CHECK(rcl_service_set_on_new_request_callback(&service, on_new, &told) == RCL_RET_OK);
  CHECK(rcl_client_set_on_new_response_callback(&client, on_new, &told_other) == RCL_RET_OK);
  agent_offer_request(REPLIERS_AT, 1, 5);
  agent_offer_request(REPLIERS_AT, 2, 5);
  pump();
  CHECK(was_told(&told, 2, 2) && was_told(&told_other, 0, 0));
  CHECK(rcl_take_request(&service, &header, &message) == RCL_RET_OK);
  CHECK(rcl_take_request(&service, &header, &message) == RCL_RET_OK);
  CHECK(rcl_send_request(&client, &question, &sequence) == RCL_RET_OK);
  agent_offer_reply(REQUESTERS_AT, 9);
  pump();
  CHECK(was_told(&told, 0, 0) && was_told(&told_other, 1, 1));
  CHECK(rcl_take_response(&client, &header, &message) == RCL_RET_OK && message.data == 9);
}

/* It wakes an executor that does not run the subscription. */
static void test_a_callback_wakes_an_executor(void)
{
  CHECK(set(1, on_new_trigger, NULL) == RCL_RET_OK);
  CHECK(take_all(1) == 1u && rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  guarded = 0;
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK && guarded == 0);
  agent_offer_number(READERS_AT + 1, 3);
  CHECK(rclc_executor_spin_some(&executor, 1000000000u) == RCL_RET_OK && guarded == 1);
  CHECK(take_all(1) == 1u && set(1, NULL, NULL) == RCL_RET_OK);
}

/* The callback outlives the session. Time passes the wrap of the milliseconds meanwhile. */
static void test_a_lost_session(void)
{
  CHECK(set(0, on_new, &told) == RCL_RET_OK);
  agent_silent = true;
  for (int i = 0; i < 300; ++i) {
    CHECK(rclc_executor_spin_some(&executor, 100000000u) == RCL_RET_OK);
  }
  agent_silent = false;
  for (int i = 0; i < 100; ++i) {
    CHECK(rclc_executor_spin_some(&executor, 100000000u) == RCL_RET_OK);
  }
  CHECK(was_told(&told, 0, 0));
  offer(0, 2);
  CHECK(was_told(&told, 2, 2) && take_all(0) == 2u);
}

int main(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);

  ask_begin();
  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "told", "", &support) == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&subscriptions[0], &node, type, "a") == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&subscriptions[1], &node, type, "b") == RCL_RET_OK);
  CHECK(rclc_service_init_default(&service, &node, &ask, "s") == RCL_RET_OK);
  CHECK(rclc_client_init_default(&client, &node, &ask, "c") == RCL_RET_OK);
  guard = rcl_get_zero_initialized_guard_condition();
  CHECK(
    rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()) ==
    RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_add_guard_condition(&executor, &guard, on_guard) == RCL_RET_OK);
  pump();
  test_arguments();
  test_messages();
  test_set_late();
  test_a_new_owner_is_not_told();
  test_services();
  test_a_callback_wakes_an_executor();
  test_a_lost_session();
  return 0;
}
