/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Callbacks that change their executor: one of each kind removes, ends or adds a handle of each kind that is its own, before
 * it or after it. All that is left has its turn once, and every request its reply.
 */
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

typedef enum kind_t { SUBSCRIPTION, TIMER, CLIENT, SERVICE, GUARD, KINDS } kind_t;
typedef enum action_t { REMOVE, END, REPLACE, ADD, ACTIONS } action_t;
enum { ACTOR, TARGET, TAIL, ROLES };
enum { READERS_AT = 3, REPLIERS_AT = READERS_AT + 2, REQUESTERS_AT = REPLIERS_AT + 3, SLOTS = 4 };

static const int64_t period = 1000000000;
static const char * const names[ROLES] = {"actor", "target", "tail"};

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rclc_executor_t executor;
static rcl_subscription_t subscriptions[2];
static rcl_timer_t timers[2];
static rcl_client_t clients[2];
static rcl_service_t services[ROLES];
static rcl_guard_condition_t guards[2];
static std_msgs__msg__Int32 messages[2];
static std_msgs__msg__Int32 replies[2];
static std_msgs__msg__Int32 requests[ROLES];
static std_msgs__msg__Int32 responses[ROLES];

static uint32_t calls[KINDS][ROLES];
static uint32_t number; /* of the last request */
static kind_t actor_kind;
static void (*act)(void); /* what the actor's callback does, once */

static void called(kind_t kind, size_t role)
{
  ++calls[kind][role];
  if (kind == actor_kind && role == ACTOR && act != NULL) {
    void (*once)(void) = act;

    act = NULL;
    once();
  }
}

static void on_message(const void * message, void * context)
{
  CHECK(message != NULL);
  called(SUBSCRIPTION, context == &subscriptions[ACTOR] ? ACTOR : TARGET);
}

/* A timer that was ended by its callback has no slot any more: the pointer distinguishes them. */
static void on_timer(rcl_timer_t * timer, int64_t last_call_time)
{
  (void)last_call_time;
  called(TIMER, timer == &timers[ACTOR] ? ACTOR : TARGET);
}

static void on_reply(const void * response)
{
  called(CLIENT, response == &replies[ACTOR] ? ACTOR : TARGET);
}

static void on_reply_with_id(const void * response, rmw_request_id_t * request_id)
{
  const int64_t sequence = request_id->sequence_number;

  on_reply(response);
  CHECK(sequence > 0 && request_id->sequence_number == sequence);
}

static void answer(const void * request, void * response)
{
  const std_msgs__msg__Int32 * asked = request;
  std_msgs__msg__Int32 * answered = response;
  const int32_t value = asked->data;

  called(SERVICE, asked == &requests[ACTOR] ? ACTOR : asked == &requests[TARGET] ? TARGET : TAIL);
  answered->data = 2 * value;
}

static void answer_with_context(const void * request, void * response, void * context)
{
  CHECK(context == &services[ACTOR]);
  answer(request, response);
}

static void answer_with_id(const void * request, rmw_request_id_t * request_id, void * response)
{
  const int64_t sequence = request_id->sequence_number;

  answer(request, response);
  CHECK(sequence > 0 && request_id->sequence_number == sequence);
}

static void on_first_guard(void)
{
  called(GUARD, ACTOR);
}

static void on_second_guard(void)
{
  called(GUARD, TARGET);
}

static void open_entity(kind_t kind, size_t role)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_ret_t result = RCL_RET_ERROR;

  switch (kind) {
    case SUBSCRIPTION:
      result = rclc_subscription_init_best_effort(&subscriptions[role], &node, type, names[role]);
      break;
    case TIMER:
      result = rclc_timer_init_default2(&timers[role], &support, (uint64_t)period, on_timer, true);
      break;
    case CLIENT:
      result = rclc_client_init_default(&clients[role], &node, &ask, names[role]);
      break;
    case SERVICE:
      result = rclc_service_init_default(&services[role], &node, &ask, names[role]);
      break;
    case GUARD:
      guards[role] = rcl_get_zero_initialized_guard_condition();
      result =
        rcl_guard_condition_init(&guards[role], &support.context, rcl_guard_condition_get_default_options());
      break;
    case KINDS:
    default:
      break;
  }
  CHECK(result == RCL_RET_OK);
}

static rcl_ret_t end_entity(kind_t kind, size_t role)
{
  switch (kind) {
    case SUBSCRIPTION:
      return rcl_subscription_fini(&subscriptions[role], &node);
    case TIMER:
      return rcl_timer_fini(&timers[role]);
    case CLIENT:
      return rcl_client_fini(&clients[role], &node);
    case SERVICE:
      return rcl_service_fini(&services[role], &node);
    case GUARD:
      return rcl_guard_condition_fini(&guards[role]);
    case KINDS:
    default:
      return RCL_RET_ERROR;
  }
}

static rcl_ret_t add_service(size_t role)
{
  if (role == ACTOR) {
    return rclc_executor_add_service_with_context(
      &executor, &services[role], &requests[role], &responses[role], answer_with_context, &services[ACTOR]);
  }
  if (role == TARGET) {
    return rclc_executor_add_service(&executor, &services[role], &requests[role], &responses[role], answer);
  }
  return rclc_executor_add_service_with_request_id(
    &executor, &services[role], &requests[role], &responses[role], answer_with_id);
}

static void add(kind_t kind, size_t role)
{
  rcl_ret_t result = RCL_RET_ERROR;

  switch (kind) {
    case SUBSCRIPTION:
      result = rclc_executor_add_subscription_with_context(
        &executor, &subscriptions[role], &messages[role], on_message, &subscriptions[role], ON_NEW_DATA);
      break;
    case TIMER:
      result = rclc_executor_add_timer(&executor, &timers[role]);
      break;
    case CLIENT:
      result = role == ACTOR ? rclc_executor_add_client_with_request_id(
                                 &executor, &clients[role], &replies[role], on_reply_with_id)
                             : rclc_executor_add_client(&executor, &clients[role], &replies[role], on_reply);
      break;
    case SERVICE:
      result = add_service(role);
      break;
    case GUARD:
      result = rclc_executor_add_guard_condition(
        &executor, &guards[role], role == ACTOR ? on_first_guard : on_second_guard);
      break;
    case KINDS:
    default:
      break;
  }
  CHECK(result == RCL_RET_OK);
}

static void remove_handle(kind_t kind, size_t role)
{
  rcl_ret_t result = RCL_RET_ERROR;

  switch (kind) {
    case SUBSCRIPTION:
      result = rclc_executor_remove_subscription(&executor, &subscriptions[role]);
      break;
    case TIMER:
      result = rclc_executor_remove_timer(&executor, &timers[role]);
      break;
    case CLIENT:
      result = rclc_executor_remove_client(&executor, &clients[role]);
      break;
    case SERVICE:
      result = rclc_executor_remove_service(&executor, &services[role]);
      break;
    case GUARD:
      result = rclc_executor_remove_guard_condition(&executor, &guards[role]);
      break;
    case KINDS:
    default:
      break;
  }
  CHECK(result == RCL_RET_OK);
}

static void pump(void)
{
  for (int i = 0; i < 6; ++i) {
    CHECK(rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)) == RMW_RET_OK);
  }
}

/* Something for the callback: a sample, a reply, a request, a trigger. Timers are due when time passes. */
static void offer(kind_t kind, size_t role)
{
  const uint16_t index = (uint16_t)role;
  const std_msgs__msg__Int32 question = {7};
  int64_t sequence = 0;

  if (kind == SUBSCRIPTION) {
    agent_offer_number((uint16_t)(READERS_AT + index), 5);
  } else if (kind == CLIENT) {
    CHECK(rcl_send_request(&clients[role], &question, &sequence) == RCL_RET_OK);
    agent_offer_reply((uint16_t)(REQUESTERS_AT + index), 9);
  } else if (kind == SERVICE) {
    ++number;
    agent_offer_request((uint16_t)(REPLIERS_AT + index), number, (int32_t)number);
  } else if (kind == GUARD) {
    CHECK(rcl_trigger_guard_condition(&guards[role]) == RCL_RET_OK);
  } else {
    agent_now_ns += period;
  }
  pump();
}

/* How often a request to the service of this role was answered, which is with twice its number. */
static size_t answered(size_t role)
{
  size_t count = 0;

  for (size_t i = 0; i < agent_reply_count; ++i) {
    if (agent_replies[i].index == REPLIERS_AT + role) {
      CHECK(agent_replies[i].value == (int32_t)(2u * agent_replies[i].number));
      ++count;
    }
  }
  return count;
}

/* --- one combination --- */

static kind_t target_kind;
static size_t target_role; /* ACTOR: the actor's own handle */
static action_t action;

static void change(void)
{
  if (action == ADD) {
    add(target_kind, target_role);
    return;
  }
  remove_handle(target_kind, target_role);
  if (action != REMOVE) {
    CHECK(end_entity(target_kind, target_role) == RCL_RET_OK);
  }
  if (action == REPLACE) {
    open_entity(target_kind, target_role);
    add(target_kind, target_role);
  }
}

static void spin(rcl_ret_t expected)
{
  rcl_ret_t first = RCL_RET_OK;

  for (int round = 0; round < 4; ++round) {
    const rcl_ret_t result = rclc_executor_spin_some(&executor, 0);

    first = first == RCL_RET_OK ? result : first;
  }
  CHECK(first == expected);
}

static void begin(rclc_executor_semantics_t semantics)
{
  executor = rclc_executor_get_zero_initialized_executor();
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_set_semantics(&executor, semantics) == RCL_RET_OK);
  memset(calls, 0, sizeof(calls));
  agent_reply_count = 0;
}

/* Every slot can be used again: none is reserved. */
static void end(void)
{
  const std_msgs__msg__Int32 message = {1};

  CHECK(rclc_executor_fini(&executor) == RCL_RET_OK);
  agent_acknowledge();
  pump();
  agent_keeps_silent = true;
  for (int i = 0; i < SLOTS; ++i) {
    CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
  }
  CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_ERROR);
  agent_keeps_silent = false;
  agent_acknowledge();
  pump();
}

static void check_own(void)
{
  const bool answers = actor_kind == SERVICE;

  if (!answers) {
    return;
  }
  CHECK(answered(ACTOR) == (action == END ? 0u : 1u));
}

static void check_target(bool before)
{
  const bool ran = before || action == ADD;

  CHECK(calls[target_kind][TARGET] == (ran ? 1u : 0u));
  if (target_kind == SERVICE) {
    CHECK(answered(TARGET) == (ran ? 1u : 0u));
  }
}

/* The request of a service whose handle was removed before its turn waits in its queue. */
static void check_added_again(void)
{
  if (target_kind == SERVICE && target_role == TARGET && action == REMOVE && answered(TARGET) == 0u) {
    add(SERVICE, TARGET);
    spin(RCL_RET_OK);
    CHECK(calls[SERVICE][TARGET] == 1u && answered(TARGET) == 1u);
  }
}

static void restore(void)
{
  if (action == END) {
    open_entity(target_kind, target_role);
    pump();
  }
}

static void combine(size_t role, bool before, rclc_executor_semantics_t semantics)
{
  const bool own = role == ACTOR;
  rcl_ret_t expected = RCL_RET_OK;

  target_role = role;
  act = change;
  begin(semantics);
  if (!own && before && action != ADD) {
    add(target_kind, TARGET);
  }
  add(actor_kind, ACTOR);
  if (!own && !before && action != ADD) {
    add(target_kind, TARGET);
  }
  add(SERVICE, TAIL);
  offer(actor_kind, ACTOR);
  if (!own) {
    offer(target_kind, TARGET);
  }
  offer(SERVICE, TAIL);
  if (own && actor_kind == SERVICE && action == END) {
    expected = RCL_RET_SERVICE_INVALID; /* there is nobody to answer any more */
  }
  spin(expected);
  CHECK(act == NULL && calls[actor_kind][ACTOR] == 1u);
  CHECK(calls[SERVICE][TAIL] == 1u && answered(TAIL) == 1u);
  if (own) {
    check_own();
  } else {
    CHECK(actor_kind != SERVICE || answered(ACTOR) == 1u);
    check_target(before);
    check_added_again();
  }
  restore();
  end();
}

static void test_combinations(rclc_executor_semantics_t semantics)
{
  for (uint32_t of = 0; of < (uint32_t)KINDS; ++of) {
    actor_kind = (kind_t)of;
    for (uint32_t what = 0; what < (uint32_t)ADD; ++what) {
      action = (action_t)what;
      target_kind = actor_kind;
      combine(ACTOR, false, semantics);
    }
    for (uint32_t to = 0; to < (uint32_t)KINDS; ++to) {
      target_kind = (kind_t)to;
      for (uint32_t what = 0; what < (uint32_t)ACTIONS; ++what) {
        action = (action_t)what;
        combine(TARGET, true, semantics);
        combine(TARGET, false, semantics);
      }
    }
  }
}

/* --- what ends while a callback runs --- */

static void end_executor(void)
{
  CHECK(rclc_executor_fini(&executor) == RCL_RET_OK);
}

static void test_a_callback_ends_its_executor(void)
{
  actor_kind = SERVICE;
  act = end_executor;
  begin(RCLC_SEMANTICS_RCLCPP_EXECUTOR);
  add(SERVICE, ACTOR);
  add(SERVICE, TAIL);
  offer(SERVICE, ACTOR);
  offer(SERVICE, TAIL);
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK && calls[SERVICE][ACTOR] == 1u);
  CHECK(answered(ACTOR) == 1u && calls[SERVICE][TAIL] == 0u);
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_ERROR);
  begin(RCLC_SEMANTICS_RCLCPP_EXECUTOR);
  add(SERVICE, TAIL);
  spin(RCL_RET_OK);
  CHECK(answered(TAIL) == 1u);
  end();
}

static void spin_within(void)
{
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  CHECK(calls[SERVICE][TAIL] == 1u && answered(TAIL) == 1u && answered(ACTOR) == 0u);
}

static void test_a_callback_spins(void)
{
  actor_kind = SERVICE;
  act = spin_within;
  begin(RCLC_SEMANTICS_RCLCPP_EXECUTOR);
  add(SERVICE, ACTOR);
  add(SERVICE, TAIL);
  offer(SERVICE, ACTOR);
  offer(SERVICE, TAIL);
  spin(RCL_RET_OK);
  CHECK(calls[SERVICE][TAIL] == 1u && answered(TAIL) == 1u && answered(ACTOR) == 1u);
  end();
}

/* --- room for replies --- */

static int accepted;

static void fill(void)
{
  const std_msgs__msg__Int32 message = {1};

  accepted = 0;
  while (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
    ++accepted;
  }
}

/* A callback that publishes until the stream is full leaves the slot of its reply; the next request waits. */
static void test_a_reply_has_its_room(rclc_executor_semantics_t semantics)
{
  actor_kind = SERVICE;
  act = fill;
  begin(semantics);
  add(SERVICE, ACTOR);
  add(SERVICE, TARGET);
  add(SERVICE, TAIL);
  offer(SERVICE, ACTOR);
  offer(SERVICE, TARGET);
  offer(SERVICE, TAIL);
  agent_keeps_silent = true;
  spin(RCL_RET_OK);
  CHECK(accepted == SLOTS - 1 && answered(ACTOR) == 1u);
  CHECK(calls[SERVICE][TARGET] == 0u && calls[SERVICE][TAIL] == 0u);
  agent_keeps_silent = false;
  agent_acknowledge();
  spin(RCL_RET_OK);
  CHECK(calls[SERVICE][TARGET] == 1u && calls[SERVICE][TAIL] == 1u);
  CHECK(answered(ACTOR) == 1u && answered(TARGET) == 1u && answered(TAIL) == 1u);
  end();
}

/* One slot is free, and three services are ready in the same round. */
static void test_one_slot_for_three(rclc_executor_semantics_t semantics)
{
  const std_msgs__msg__Int32 message = {1};

  act = NULL;
  begin(semantics);
  add(SERVICE, ACTOR);
  add(SERVICE, TARGET);
  add(SERVICE, TAIL);
  offer(SERVICE, ACTOR);
  offer(SERVICE, TARGET);
  offer(SERVICE, TAIL);
  agent_keeps_silent = true;
  for (int i = 0; i < SLOTS - 1; ++i) {
    CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
  }
  spin(RCL_RET_OK);
  CHECK(agent_reply_count == 1u && calls[SERVICE][ACTOR] == 1u);
  CHECK(calls[SERVICE][TARGET] == 0u && calls[SERVICE][TAIL] == 0u);
  agent_keeps_silent = false;
  agent_acknowledge();
  spin(RCL_RET_OK);
  CHECK(agent_reply_count == 3u && answered(TARGET) == 1u && answered(TAIL) == 1u);
  end();
}

/* --- an executor that was copied --- */

static rclc_executor_t made(void)
{
  rclc_executor_t fresh = rclc_executor_get_zero_initialized_executor();

  CHECK(rclc_executor_init(&fresh, &support.context, 1, &allocator) == RCL_RET_OK);
  return fresh;
}

static void test_a_copied_executor_keeps_and_frees_its_place(void)
{
  for (int i = 0; i < 5; ++i) {
    rclc_executor_t first = made();
    rclc_executor_t second = made();

    CHECK(first.handles != second.handles);
    CHECK(rclc_executor_fini(&first) == RCL_RET_OK && rclc_executor_fini(&second) == RCL_RET_OK);
  }
}

int main(void)
{
  ask_begin();
  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "runner", "", &support) == RCL_RET_OK);
  CHECK(
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "out") == RCL_RET_OK);
  for (uint32_t kind = 0; kind < (uint32_t)KINDS; ++kind) {
    open_entity((kind_t)kind, ACTOR);
    open_entity((kind_t)kind, TARGET);
  }
  open_entity(SERVICE, TAIL);
  pump();
  test_combinations(RCLC_SEMANTICS_RCLCPP_EXECUTOR);
  test_combinations(RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME);
  test_a_callback_ends_its_executor();
  test_a_callback_spins();
  test_a_reply_has_its_room(RCLC_SEMANTICS_RCLCPP_EXECUTOR);
  test_a_reply_has_its_room(RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME);
  test_one_slot_for_three(RCLC_SEMANTICS_RCLCPP_EXECUTOR);
  test_one_slot_for_three(RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME);
  test_a_copied_executor_keeps_and_frees_its_place();
  return 0;
}
