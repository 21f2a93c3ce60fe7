/* SPDX-License-Identifier: Apache-2.0 */
/* Nodes of executors, as a table of calls: each row is a call, its result, and what rounds of both executors call after it. */
#include "port_agent.h"
#include "types.h"
#include "unit.h"
#include "unit_service.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/executor_nodes.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <string.h>

enum { READERS_AT = 3, REPLIERS_AT = READERS_AT + 2, NOTES = 32 };

static const int64_t period = 1000000000;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t left;  /* has subscription a, service s, timer t */
static rcl_node_t right; /* has subscription b */
static rcl_node_t none;
static rclc_executor_t first;
static rclc_executor_t second;
static rcl_subscription_t subscriptions[2];
static rcl_service_t service;
static rcl_timer_t timer;
static std_msgs__msg__Int32 messages[2];
static std_msgs__msg__Int32 request;
static std_msgs__msg__Int32 response;
static uint32_t asked;
static char notes[NOTES];
static bool only_once;    /* one round */
static void (*act)(void); /* what the next callback of a does, once */

static void note(char letter)
{
  notes[strlen(notes)] = letter;
}

static bool noted(const char * expected)
{
  const bool same = strcmp(notes, expected) == 0;

  if (!same) {
    (void)fprintf(stderr, "noted '%s', expected '%s'\n", notes, expected);
  }
  memset(notes, 0, sizeof(notes));
  return same;
}

static void on_a(const void * message)
{
  void (*once)(void) = act;

  (void)message;
  note('a');
  act = NULL;
  if (once != NULL) {
    once();
  }
}

static void on_b(const void * message)
{
  (void)message;
  note('b');
}

static void on_service(const void * question, void * answer)
{
  (void)question;
  (void)answer;
  note('s');
}

static void on_timer(rcl_timer_t * late, int64_t last_call_time)
{
  (void)late;
  (void)last_call_time;
  note('t');
}

static void pump(void)
{
  for (int i = 0; i < 6; ++i) {
    CHECK(rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)) == RMW_RET_OK);
  }
}

/* Everything is due; then two rounds of each executor, those of the second after a bar. */
static void rounds(void)
{
  agent_offer_number(READERS_AT, 1);
  agent_offer_number(READERS_AT + 1, 2);
  ++asked;
  agent_reply_count = 0;
  agent_waits = 0;
  agent_offer_request(REPLIERS_AT, asked, 3);
  agent_now_ns += period;
  pump();
  memset(notes, 0, sizeof(notes));
  CHECK(rclc_executor_spin_some(&first, 0) == RCL_RET_OK);
  CHECK(only_once || rclc_executor_spin_some(&first, 0) == RCL_RET_OK);
  note('|');
  CHECK(rclc_executor_spin_some(&second, 0) == RCL_RET_OK);
  CHECK(only_once || rclc_executor_spin_some(&second, 0) == RCL_RET_OK);
}

static rcl_ret_t remove_left(void)
{
  return rclc_executor_remove_node(&first, &left);
}

static rcl_ret_t remove_right(void)
{
  return rclc_executor_remove_node(&first, &right);
}

static rcl_ret_t add_left(void)
{
  return rclc_executor_add_node(&first, &left);
}

static rcl_ret_t add_right(void)
{
  return rclc_executor_add_node(&first, &right);
}

static rcl_ret_t move_left(void)
{
  return rclc_executor_move_node(&first, &left, &second);
}

static rcl_ret_t move_left_back(void)
{
  return rclc_executor_move_node(&second, &left, &first);
}

static rcl_ret_t move_to_itself(void)
{
  return rclc_executor_move_node(&first, &left, &first);
}

static rcl_ret_t remove_none(void)
{
  return rclc_executor_remove_node(&first, &none);
}

/* What had waited for a removed node is called when it is back. */
typedef struct step_t {
  rcl_ret_t (*call)(void);
  rcl_ret_t result;
  const char * noted;
  size_t running; /* handles of the left node in the first executor, then those put aside */
  size_t removed;
} step_t;

static const step_t steps[] = {
  {remove_none, RCL_RET_NODE_INVALID, "abst|", 3, 0},
  {add_left, RCL_RET_ERROR, "abst|", 3, 0},
  {move_to_itself, RCL_RET_ERROR, "abst|", 3, 0},
  {remove_left, RCL_RET_OK, "b|", 0, 3},
  {remove_left, RCL_RET_ERROR, "b|", 0, 3},
  {remove_right, RCL_RET_OK, "|", 0, 3},
  {move_left, RCL_RET_ERROR, "|", 0, 3},
  {add_left, RCL_RET_OK, "astas|", 3, 0},
  {add_right, RCL_RET_OK, "astbb|", 3, 0},
  {move_left, RCL_RET_OK, "b|ast", 0, 0},
  {remove_left, RCL_RET_ERROR, "b|ast", 0, 0},
  {move_left_back, RCL_RET_OK, "bast|", 3, 0},
};

static void check_info(size_t running, size_t removed)
{
  rclc_executor_node_info_t info;

  CHECK(rclc_executor_query_node(&first, &left, &info) == RCL_RET_OK);
  CHECK(info.running == running && info.removed == removed);
  CHECK(
    first.info.number_of_subscriptions + first.info.number_of_services + first.info.number_of_timers ==
    first.index);
}

static void begin(void)
{
  CHECK(rclc_executor_init(&first, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_init(&second, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&first, &subscriptions[0], &messages[0], on_a, ON_NEW_DATA) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&first, &subscriptions[1], &messages[1], on_b, ON_NEW_DATA) == RCL_RET_OK);
  CHECK(rclc_executor_add_service(&first, &service, &request, &response, on_service) == RCL_RET_OK);
  CHECK(rclc_executor_add_timer(&first, &timer) == RCL_RET_OK);
  check_info(2, 0);
  CHECK(rclc_executor_set_node(&first, &timer, &left) == RCL_RET_OK);
  check_info(3, 0);
}

static void end(void)
{
  CHECK(rclc_executor_fini(&first) == RCL_RET_OK && rclc_executor_fini(&second) == RCL_RET_OK);
}

static void test_arguments(void)
{
  rclc_executor_t fresh = rclc_executor_get_zero_initialized_executor();
  rclc_executor_node_info_t info;

  CHECK(rclc_executor_add_node(NULL, &left) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_add_node(&first, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_remove_node(&fresh, &left) == RCL_RET_ERROR);
  CHECK(rclc_executor_move_node(&first, &left, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_move_node(&first, &left, &fresh) == RCL_RET_ERROR);
  CHECK(rclc_executor_query_node(&first, &none, &info) == RCL_RET_NODE_INVALID);
  CHECK(rclc_executor_query_node(&first, &left, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_set_node(&first, NULL, &left) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_set_node(&second, &timer, &left) == RCL_RET_ERROR);
}

static void remove_in_callback(void)
{
  CHECK(rclc_executor_remove_node(&first, &left) == RCL_RET_OK);
}

static void add_in_callback(void)
{
  CHECK(rclc_executor_remove_node(&first, &left) == RCL_RET_OK);
  CHECK(rclc_executor_add_node(&first, &left) == RCL_RET_OK);
}

static void move_in_callback(void)
{
  CHECK(rclc_executor_move_node(&first, &left, &second) == RCL_RET_OK);
}

static void drain(void)
{
  for (int i = 0; i < 8; ++i) {
    CHECK(rclc_executor_spin_some(&first, 0) == RCL_RET_OK);
    CHECK(rclc_executor_spin_some(&second, 0) == RCL_RET_OK);
    agent_acknowledge();
    pump();
  }
}

/* A callback changes its own node: no handle of it has a turn any more in this round, the others have. */
static void test_in_callbacks(rclc_executor_semantics_t semantics)
{
  begin();
  drain();
  CHECK(rclc_executor_set_semantics(&first, semantics) == RCL_RET_OK);
  act = remove_in_callback;
  rounds();
  CHECK(noted("ab|"));
  CHECK(rclc_executor_add_node(&first, &left) == RCL_RET_OK);
  drain();
  act = add_in_callback;
  only_once = true;
  rounds();
  CHECK(noted("ba|")); /* the others of its node have their turn in the next round */
  CHECK(rclc_executor_spin_some(&first, 0) == RCL_RET_OK && noted("st"));
  only_once = false;
  act = move_in_callback;
  rounds();
  CHECK(noted("ba|st"));
  end();
}

/* Places of removed nodes count: all five handles are in use. */
static void test_places(void)
{
  rcl_guard_condition_t guard = rcl_get_zero_initialized_guard_condition();

  begin();
  CHECK(
    rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()) ==
    RCL_RET_OK);
  CHECK(rclc_executor_remove_node(&first, &left) == RCL_RET_OK);
  for (int i = 0; i < 2; ++i) {
    CHECK(
      rclc_executor_add_subscription(&second, &subscriptions[1], &messages[1], on_b, ON_NEW_DATA) ==
      RCL_RET_OK);
  }
  CHECK(rclc_executor_add_timer(&first, &timer) == RCL_RET_OK);
  CHECK(rclc_executor_add_timer(&first, &timer) == RCL_RET_ERROR);
  CHECK(rclc_executor_remove_timer(&first, &timer) == RCL_RET_OK);
  CHECK(rclc_executor_add_node(&first, &left) == RCL_RET_OK);
  check_info(3, 0);
  CHECK(rclc_executor_add_timer(&second, &timer) == RCL_RET_OK);
  CHECK(rclc_executor_move_node(&first, &left, &second) == RCL_RET_ERROR); /* two free places for three */
  CHECK(strstr(rcl_get_error_string().str, "handles: 6") != NULL);
  check_info(3, 0);
  CHECK(rcl_guard_condition_fini(&guard) == RCL_RET_OK);
  end();
}

/* The session is lost and found: what is put aside stays so, and has what arrived meanwhile. */
static void test_a_lost_session(void)
{
  begin();
  CHECK(rclc_executor_remove_node(&first, &left) == RCL_RET_OK);
  agent_silent = true;
  for (int i = 0; i < 300; ++i) {
    CHECK(rclc_executor_spin_some(&first, 100000000u) == RCL_RET_OK);
  }
  agent_silent = false;
  for (int i = 0; i < 100; ++i) {
    CHECK(rclc_executor_spin_some(&first, 100000000u) == RCL_RET_OK);
  }
  check_info(0, 3);
  rounds();
  CHECK(noted("b|"));
  CHECK(rclc_executor_add_node(&first, &left) == RCL_RET_OK);
  drain();
  rounds();
  CHECK(noted("bast|"));
  end();
}

static void open_entities(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);

  CHECK(rclc_node_init_default(&left, "left", "", &support) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&right, "right", "", &support) == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&subscriptions[0], &left, type, "a") == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&subscriptions[1], &right, type, "b") == RCL_RET_OK);
  CHECK(rclc_service_init_default(&service, &left, &ask, "s") == RCL_RET_OK);
  CHECK(rclc_timer_init_default2(&timer, &support, (uint64_t)period, on_timer, true) == RCL_RET_OK);
}

int main(void)
{
  ask_begin();
  allocator = rcl_get_default_allocator();
  none = rcl_get_zero_initialized_node();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  open_entities();
  pump();
  begin();
  test_arguments();
  for (size_t i = 0; i < sizeof(steps) / sizeof(steps[0]); ++i) {
    (void)fprintf(stderr, "step %u\n", (unsigned)i);
    CHECK(steps[i].call() == steps[i].result);
    check_info(steps[i].running, steps[i].removed);
    rounds();
    CHECK(noted(steps[i].noted));
  }
  end();
  test_in_callbacks(RCLC_SEMANTICS_RCLCPP_EXECUTOR);
  test_in_callbacks(RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME);
  test_places();
  test_a_lost_session();
  return 0;
}
