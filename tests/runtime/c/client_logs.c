/* SPDX-License-Identifier: Apache-2.0 */
/* Log messages and a publisher in the hands of the test: one call for each line of standard input. */
#include "fake_program.h"

#include <rcl/error_handling.h>
#include <rcl/logging_rosout.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rcutils/logging_macros.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_allocator_t allocator;

static rcl_ret_t start(void)
{
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "device", "arm", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count");
  }
  return result;
}

static rcl_ret_t publish(void)
{
  static std_msgs__msg__Int32 message;
  const rcl_ret_t result = rcl_publish(&publisher, &message, NULL);

  if (result == RCL_RET_OK) {
    ++message.data;
  }
  return result;
}

static rcl_ret_t print_counts(void)
{
  const rcutils_logging_counts_t counts = rcutils_logging_get_counts();

  printf("counts truncated=%" PRIu32 " dropped=%" PRIu32 "\n", counts.truncated, counts.dropped);
  return RCL_RET_OK;
}

static rcl_ret_t end(void)
{
  const rcl_ret_t result = rcl_node_fini(&node);

  return result == RCL_RET_OK ? rclc_support_fini(&support) : result;
}

typedef rcl_ret_t (*change_t)(const char * logger, const char * name);

/* Changes the sublogger of both names; `-` is an empty one, and `0` none. */
static rcl_ret_t sublogger(const char * text, change_t change)
{
  char names[2][48] = {"", ""};
  const char * given[2] = {names[0], names[1]};

  if (sscanf(text, "%47s %47s", names[0], names[1]) != 2) {
    abort();
  }
  for (size_t i = 0; i < 2u; ++i) {
    if (strcmp(names[i], "0") == 0) {
      given[i] = NULL;
    } else if (strcmp(names[i], "-") == 0) {
      names[i][0] = '\0';
    }
  }
  return change(given[0], given[1]);
}

static rcl_ret_t call(const char * line)
{
  const char * space = strchr(line, ' ');
  const char * text = space != NULL ? &space[1] : "";

  switch (line[0]) {
    case 'i': /* init */
      return start();
    case 'w': /* warn TEXT */
      RCUTILS_LOG_WARN_NAMED("arm", "%s", text);
      return RCL_RET_OK;
    case 'd': /* debug TEXT */
      RCUTILS_LOG_DEBUG_NAMED("arm", "%s", text);
      return RCL_RET_OK;
    case 'n': /* named NAME */
      rcutils_log(NULL, RCUTILS_LOG_SEVERITY_FATAL, text, "named");
      return RCL_RET_OK;
    case 'p': /* publish */
      return publish();
    case 'k': /* keep no publisher */
      return rcl_logging_rosout_fini_publisher_for_node(&node);
    case 'o': /* open it again */
      return rcl_logging_rosout_init_publisher_for_node(&node);
    case 'a': /* add LOGGER SUBLOGGER */
      return sublogger(text, rcl_logging_rosout_add_sublogger);
    case 'r': /* remove LOGGER SUBLOGGER */
      return sublogger(text, rcl_logging_rosout_remove_sublogger);
    case 'c': /* counts */
      return print_counts();
    case 'e': /* end */
      return end();
    default: /* spin */
      return rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
  }
}

static void work(char * line)
{
  report_result(call(line));
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  return run_calls(work);
}
