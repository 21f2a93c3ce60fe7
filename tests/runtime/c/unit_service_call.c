/* SPDX-License-Identifier: Apache-2.0 */
/* Calls of a service that wait: answered in time, late, never; refused in callbacks; the clock wraps; the session is lost. */
#include "port_agent.h"
#include "types.h"
#include "unit.h"
#include "unit_service.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc/service_call.h>
#include <rmw_microros/rmw_microros.h>

#include <string.h>

enum { REQUESTERS_AT = 3 + 2 + 3, FAR = 0, RUN = 1 };

static const int64_t ms = 1000000;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rclc_executor_t executor;
static rclc_executor_t other;
static rcl_client_t clients[2];
static rcl_guard_condition_t guard;
static std_msgs__msg__Int32 question;
static std_msgs__msg__Int32 response;
static std_msgs__msg__Int32 reply_of_callback;
static int replies;
static rcl_ret_t result_in_callback;

static void on_reply(const void * message)
{
  CHECK(message == &reply_of_callback);
  ++replies;
}

static rcl_ret_t call(int64_t timeout)
{
  response.data = -1;
  return rclc_executor_call_service(&executor, &clients[FAR], &question, &response, (uint64_t)timeout);
}

static void answer(void)
{
  agent_offer_reply((uint16_t)(REQUESTERS_AT + FAR), 9);
}

/* The server answers after this time. */
static void answer_after(int64_t time)
{
  agent_event = answer;
  agent_event_ns = agent_now_ns + time;
}

static void test_arguments(void)
{
  const uint64_t second = 1000000000u;
  rcl_client_t none = rcl_get_zero_initialized_client();

  CHECK(
    rclc_executor_call_service(NULL, &clients[FAR], &question, &response, second) ==
    RCL_RET_INVALID_ARGUMENT);
  CHECK(
    rclc_executor_call_service(&executor, NULL, &question, &response, second) == RCL_RET_INVALID_ARGUMENT);
  CHECK(
    rclc_executor_call_service(&executor, &clients[FAR], NULL, &response, second) ==
    RCL_RET_INVALID_ARGUMENT);
  CHECK(
    rclc_executor_call_service(&executor, &clients[FAR], &question, NULL, second) ==
    RCL_RET_INVALID_ARGUMENT);
  CHECK(call(0) == RCL_RET_INVALID_ARGUMENT && call(-1) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_executor_call_service(&executor, &none, &question, &response, second) == RCL_RET_CLIENT_INVALID);
}

/* Time begins 2 s before the milliseconds wrap: the calls before and after it are as long as any other. */
static void test_time_out_and_late_response(void)
{
  const int64_t start = agent_now_ns;

  CHECK(call(3000 * ms) == RCL_RET_TIMEOUT);
  CHECK(agent_now_ns - start >= 3000 * ms && agent_now_ns - start <= 3010 * ms);
  CHECK(strstr(rcl_get_error_string().str, "3000 ms") != NULL);
  rcl_reset_error();
  answer(); /* to the first request */
  answer_after(100 * ms);
  CHECK(call(3000 * ms) == RCL_RET_OK && response.data == 9);
  CHECK(agent_now_ns - start >= 3100 * ms && agent_now_ns - start <= 3200 * ms);
  CHECK(call(5 * ms) == RCL_RET_TIMEOUT);
}

static void call_in_callback(void)
{
  result_in_callback = call(1000 * ms);
}

static void call_of_other(void)
{
  answer_after(1 * ms);
  result_in_callback =
    rclc_executor_call_service(&other, &clients[FAR], &question, &response, (uint64_t)(1000 * ms));
}

static void spin_inside(void)
{
  CHECK(rcl_trigger_guard_condition(&guard) == RCL_RET_OK);
  CHECK(rclc_executor_remove_guard_condition(&executor, &guard) == RCL_RET_OK);
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  result_in_callback = call(1000 * ms);
}

/* Runs a callback in the executor. */
static void run(rclc_gc_callback_t callback)
{
  result_in_callback = RCL_RET_OK;
  CHECK(rclc_executor_add_guard_condition(&executor, &guard, callback) == RCL_RET_OK);
  CHECK(rcl_trigger_guard_condition(&guard) == RCL_RET_OK);
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
}

static void test_callbacks_must_not_wait(void)
{
  const int64_t start = agent_now_ns;

  run(call_in_callback);
  CHECK(result_in_callback == RCL_RET_ERROR && agent_now_ns == start);
  CHECK(strstr(rcl_get_error_string().str, "callback") != NULL);
  CHECK(rclc_executor_remove_guard_condition(&executor, &guard) == RCL_RET_OK);
  run(spin_inside); /* the inner round does not end the outer one */
  CHECK(result_in_callback == RCL_RET_ERROR);
  run(call_of_other);
  CHECK(result_in_callback == RCL_RET_OK && response.data == 9);
  CHECK(rclc_executor_remove_guard_condition(&executor, &guard) == RCL_RET_OK);
  answer_after(1 * ms);
  CHECK(call(1000 * ms) == RCL_RET_OK); /* after the round */
}

/* Responses of a client that the executor runs belong to its callback. */
static void test_client_of_the_executor(void)
{
  CHECK(rclc_executor_add_client(&executor, &clients[FAR], &reply_of_callback, on_reply) == RCL_RET_OK);
  CHECK(call(1000 * ms) == RCL_RET_ERROR);
  CHECK(strstr(rcl_get_error_string().str, "client") != NULL);
  CHECK(rclc_executor_remove_client(&executor, &clients[FAR]) == RCL_RET_OK);
  CHECK(rclc_executor_add_client(&executor, &clients[RUN], &reply_of_callback, on_reply) == RCL_RET_OK);
  answer_after(1 * ms);
  CHECK(call(1000 * ms) == RCL_RET_OK);
}

/* The response of the other client arrives meanwhile: it waits for its callback. */
static void test_other_messages_wait(void)
{
  int64_t sequence = 0;

  CHECK(rcl_send_request(&clients[RUN], &question, &sequence) == RCL_RET_OK);
  agent_offer_reply((uint16_t)(REQUESTERS_AT + RUN), 4);
  answer_after(50 * ms);
  replies = 0;
  CHECK(call(1000 * ms) == RCL_RET_OK && response.data == 9 && replies == 0);
  CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  CHECK(replies == 1 && reply_of_callback.data == 4);
}

static void hear_again(void)
{
  agent_silent = false;
}

/* The agent vanishes with the request, and returns: the call ends before its time-out, and says why. */
static void test_a_lost_session(void)
{
  agent_silent = true;
  agent_event = hear_again;
  agent_event_ns = agent_now_ns + 30000 * ms;
  CHECK(call(100000 * ms) == RCL_RET_ERROR);
  CHECK(strstr(rcl_get_error_string().str, "session was lost") != NULL);
  agent_silent = false;
  for (int i = 0; i < 100; ++i) {
    CHECK(rclc_executor_spin_some(&executor, (uint64_t)(100 * ms)) == RCL_RET_OK);
  }
  answer_after(10 * ms);
  CHECK(call(1000 * ms) == RCL_RET_OK && response.data == 9);
}

int main(void)
{
  ask_begin();
  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "caller", "", &support) == RCL_RET_OK);
  CHECK(rclc_client_init_default(&clients[FAR], &node, &ask, "far") == RCL_RET_OK);
  CHECK(rclc_client_init_default(&clients[RUN], &node, &ask, "run") == RCL_RET_OK);
  guard = rcl_get_zero_initialized_guard_condition();
  CHECK(
    rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()) ==
    RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_init(&other, &support.context, 1, &allocator) == RCL_RET_OK);
  test_arguments();
  test_time_out_and_late_response();
  test_callbacks_must_not_wait();
  test_client_of_the_executor();
  test_other_messages_wait();
  test_a_lost_session();
  return 0;
}
