/* SPDX-License-Identifier: Apache-2.0 */
/* A node of a simulation: an ordinary application of rclc. Says what time it is when that changes, when its timer of 100 ms
 * ticks, and when time jumps; publishes the number of ticks. Ends when time reaches the second of its argument. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdio.h>
#include <stdlib.h>

#define CHECK(call) \
  if ((call) != RCL_RET_OK) { \
    fprintf(stderr, "line %d: %s\n", __LINE__, rcl_get_error_string().str); \
    return 1; \
  }

static rclc_support_t support;
static rcl_publisher_t publisher;
static std_msgs__msg__Int32 ticks;

static void say(const char * what, int64_t value)
{
  printf("%s %lld\n", what, (long long)value);
  fflush(stdout);
}

static int64_t now(void)
{
  int64_t value = -1;

  return rcl_clock_get_now(&support.clock, &value) == RCL_RET_OK ? value : -1;
}

static void on_timer(rcl_timer_t * timer, int64_t last_call_time)
{
  (void)last_call_time;
  (void)timer;
  ticks.data++;
  say("tick", now());
  if (rcl_publish(&publisher, &ticks, NULL) != RCL_RET_OK) {
    say("lost", ticks.data);
  }
}

static void on_jump(const rcl_time_jump_t * jump, bool before_jump, void * user_data)
{
  (void)user_data;
  if (!before_jump) {
    say("jump", jump->delta.nanoseconds);
  }
}

int main(int argc, char ** argv)
{
  const int64_t end = argc > 1 ? RCL_S_TO_NS(atoll(argv[1])) : 0;
  const rcl_jump_threshold_t threshold = {true, {RCL_S_TO_NS(1)}, {-1}};
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  int64_t said = 0;
  rcl_node_t node;
  rcl_timer_t timer;

  CHECK(rclc_support_init(&support, 0, NULL, &allocator));
  CHECK(rclc_node_init_default(&node, "simulated", "", &support));
  CHECK(rclc_publisher_init_default(
    &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "ticks"));
  CHECK(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(100), on_timer, true));
  CHECK(rcl_clock_add_jump_callback(&support.clock, threshold, on_jump, NULL));
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator));
  CHECK(rclc_executor_add_timer(&executor, &timer));
  say("now", now());
  while (now() < end) {
    CHECK(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(20)));
    if (now() != said) {
      said = now();
      say("now", said);
    }
  }
  CHECK(rcl_timer_fini(&timer));
  CHECK(rcl_publisher_fini(&publisher, &node));
  CHECK(rcl_node_fini(&node));
  CHECK(rclc_support_fini(&support));
  return 0;
}
