/* SPDX-License-Identifier: Apache-2.0 */
/* An action that counts Fibonacci numbers, one in each step of a timer; two goals at once, each of which can be canceled. */
#include "../example.h"

#include <example_interfaces/action/fibonacci.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

enum { GOALS = 2, NUMBERS = 20, STEP_MS = 100 };

typedef struct {
  rclc_action_goal_handle_t * goal; /* NULL: free */
  int32_t numbers[NUMBERS];
  size_t size;
  size_t order;
} job_t;

static rclc_support_t support;
static rcl_node_t node;
static rclc_action_server_t server;
static rcl_timer_t timer;
static rclc_executor_t executor;
static example_interfaces__action__Fibonacci_SendGoal_Request requests[GOALS];
static job_t jobs[GOALS];

static rcl_ret_t accept_goal(rclc_action_goal_handle_t * goal, void * context)
{
  const example_interfaces__action__Fibonacci_SendGoal_Request * request =
    (example_interfaces__action__Fibonacci_SendGoal_Request *)goal->ros_goal_request;

  (void)context;
  for (size_t i = 0; i < GOALS; ++i) {
    if (jobs[i].goal == NULL && request->goal.order > 0 && request->goal.order < NUMBERS) {
      jobs[i].goal = goal;
      jobs[i].size = 0;
      jobs[i].order = (size_t)request->goal.order;
      (void)printf("accepted %d\n", (int)request->goal.order);
      return RCL_RET_ACTION_GOAL_ACCEPTED;
    }
  }
  (void)printf("rejected %d\n", (int)request->goal.order);
  return RCL_RET_ACTION_GOAL_REJECTED;
}

static bool accept_cancel(rclc_action_goal_handle_t * goal, void * context)
{
  (void)goal;
  (void)context;
  return true; /* the next step ends it */
}

static void end(job_t * job, rcl_action_goal_state_t status)
{
  example_interfaces__action__Fibonacci_GetResult_Response response = {0};

  response.result.sequence.data = job->numbers;
  response.result.sequence.size = job->size;
  response.result.sequence.capacity = NUMBERS;
  if (example_tell(rclc_action_send_result(job->goal, status, &response), "result")) {
    (void)printf(
      "%s with %u numbers\n", status == GOAL_STATE_SUCCEEDED ? "ended" : "canceled", (unsigned)job->size);
    job->goal = NULL;
  }
}

static void count(job_t * job)
{
  example_interfaces__action__Fibonacci_FeedbackMessage message = {0};

  job->numbers[job->size] =
    job->size < 2u ? (int32_t)job->size : job->numbers[job->size - 1u] + job->numbers[job->size - 2u];
  ++job->size;
  message.feedback.sequence.data = job->numbers;
  message.feedback.sequence.size = job->size;
  message.feedback.sequence.capacity = NUMBERS;
  (void)example_tell(rclc_action_publish_feedback(job->goal, &message), "feedback");
}

static void step(rcl_timer_t * stepping, int64_t last_call_time)
{
  (void)stepping;
  (void)last_call_time;
  for (size_t i = 0; i < GOALS; ++i) {
    if (jobs[i].goal == NULL) {
      continue;
    }
    if (jobs[i].goal->goal_cancelled) {
      end(&jobs[i], GOAL_STATE_CANCELED);
    } else if (jobs[i].size <= jobs[i].order) {
      count(&jobs[i]);
    } else {
      end(&jobs[i], GOAL_STATE_SUCCEEDED);
    }
  }
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "counter", "", &support), "node");
  example_check(
    rclc_action_server_init_default(
      &server, &node, &support, ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci), "fibonacci"),
    "action server");
  example_check(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(STEP_MS), step, true), "timer");

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 2, &allocator), "executor");
  example_check(
    rclc_executor_add_action_server(
      &executor, &server, GOALS, requests, sizeof(requests[0]), accept_goal, accept_cancel, NULL),
    "add action server");
  example_check(rclc_executor_add_timer(&executor, &timer), "add timer");
  while (example_runs()) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rcl_timer_fini(&timer), "end of the timer");
  example_check(rclc_action_server_fini(&server, &node), "end of the action server");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
