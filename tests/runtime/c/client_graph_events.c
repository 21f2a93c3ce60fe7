/* SPDX-License-Identifier: Apache-2.0 */
/* A node with events from the graph in the hands of the test: "init", "open", "listen", "spin MS", "take", "fini", "close". */
#include "fake_program.h"
#include "fake_steps.h"

#include <rcl/event.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdlib.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rclc_executor_t executor;
static rcl_event_t matched;
static rcl_event_t incompatible;
static size_t told;

static void on_event(const void * user_data, size_t number_of_events)
{
  (void)user_data;
  told += number_of_events;
}

static rcl_ret_t init(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "device", "arm", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count");
  }
  return result == RCL_RET_OK ? rclc_executor_init(&executor, &support.context, 1, &allocator) : result;
}

static rcl_ret_t open_events(void)
{
  rcl_ret_t result;

  matched = rcl_get_zero_initialized_event();
  incompatible = rcl_get_zero_initialized_event();
  result = rcl_publisher_event_init(&matched, &publisher, RCL_PUBLISHER_MATCHED);
  return result == RCL_RET_OK
           ? rcl_publisher_event_init(&incompatible, &publisher, RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS)
           : result;
}

static rcl_ret_t take(void)
{
  rmw_matched_status_t status;
  rmw_offered_qos_incompatible_event_status_t other;
  rcl_ret_t result = rcl_take_event(&matched, &status);

  if (result == RCL_RET_OK) {
    result = rcl_take_event(&incompatible, &other);
  }
  if (result == RCL_RET_OK) {
    (void)printf(
      "status %zu %zu %zu %d %d %d %d %zu\n", status.total_count, status.total_count_change,
      status.current_count, (int)status.current_count_change, (int)other.total_count,
      (int)other.total_count_change, (int)other.last_policy_kind, told);
  }
  return result;
}

static rcl_ret_t listen(void)
{
  const rcl_ret_t result = rcl_event_set_callback(&matched, on_event, NULL);

  return result == RCL_RET_OK ? rcl_event_set_callback(&incompatible, on_event, NULL) : result;
}

static rcl_ret_t fini(void)
{
  const rcl_ret_t result = rcl_event_fini(&matched);

  return result == RCL_RET_OK ? rcl_event_fini(&incompatible) : result;
}

static void work(char * line)
{
  const char * word = strtok(line, " ");
  const char * number = strtok(NULL, " ");

  if (strcmp(word, "init") == 0) {
    report_result(init());
  } else if (strcmp(word, "open") == 0) {
    report_result(open_events());
  } else if (strcmp(word, "listen") == 0) {
    report_result(listen());
  } else if (strcmp(word, "take") == 0) {
    report_result(take());
  } else if (strcmp(word, "fini") == 0) {
    report_result(fini());
  } else if (strcmp(word, "close") == 0) {
    report_result(rcl_publisher_fini(&publisher, &node));
  } else {
    report_result(rclc_executor_spin_some(&executor, (uint64_t)RCL_MS_TO_NS(atoi(number))));
  }
}

int main(void)
{
  return run_calls(work);
}
