/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Publishes while the line takes nothing: LARGE_COUNT large reliable messages and SMALL_COUNT small best-effort ones, and
 * keeps in large_report how long the longest publish took, in counts of SysTick; then goes on until all is acknowledged.
 */
#include <microros/port.h>
#include <microros/port_board.h>
#include <microros/port_cortex_m.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/string.h>

#define SYST_CVR 0xe000e018u

#ifndef LARGE_SIZE
#define LARGE_SIZE 7000
#endif

enum { LARGE_COUNT = 3, SMALL_COUNT = 4000, PAUSE_MS = 1500, STEP_MS = 2, FLUSH_MS = 20 };

typedef struct large_report_t {
  uint32_t ready;     /* 1: the line may stop now */
  uint32_t published; /* 1: all calls of rcl_publish have returned */
  uint32_t done;      /* 1: everything that was taken is acknowledged */
  uint32_t large_taken;
  uint32_t small_taken;
  uint32_t large_ticks; /* of the longest call */
  uint32_t small_ticks;
  uint32_t dropped;
} large_report_t;

volatile large_report_t large_report;

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t large;
static rcl_publisher_t small;
static char text[LARGE_SIZE + 1];

static uint32_t ticks(void)
{
  uint32_t now_ms;
  uint32_t left;

  do {
    now_ms = port_time_ms();
    left = PORT_CORTEX_M_REGISTER(SYST_CVR);
  } while (now_ms != port_time_ms());
  return now_ms * PORT_BOARD_TICKS_PER_MS + (PORT_BOARD_TICKS_PER_MS - 1u - left);
}

/* Publishes `count` times, and returns how often it was taken. */
static uint32_t publish(
  rcl_publisher_t * publisher, const void * message, uint32_t count, volatile uint32_t * longest)
{
  uint32_t taken = 0;

  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t start = ticks();
    const rcl_ret_t result = rcl_publish(publisher, message, NULL);
    const uint32_t took = ticks() - start;

    if (took > *longest) {
      *longest = took;
    }
    taken += result == RCL_RET_OK ? 1u : 0u;
    rcl_reset_error();
  }
  return taken;
}

static bool start(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "large", "", &support) == RCL_RET_OK &&
         rclc_publisher_init_default(
           &large, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String), "text") == RCL_RET_OK &&
         rclc_publisher_init_best_effort(
           &small, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count") == RCL_RET_OK;
}

int main(void)
{
  const std_msgs__msg__Int32 number = {0x7e7e7e7e}; /* each byte is stuffed */
  std_msgs__msg__String message = {{text, LARGE_SIZE, LARGE_SIZE + 1}};
  rmw_uros_statistics_t statistics;
  rmw_context_t * context;

  for (uint32_t i = 0; i < LARGE_SIZE; ++i) {
    text[i] = (char)('%' + i % 90u); /* 7D and 7E among them */
  }
  if (!start()) {
    return 1;
  }
  context = rcl_context_get_rmw_context(&support.context);
  large_report.ready = 1;
  port_sleep_ms(PAUSE_MS);
  large_report.small_taken = publish(&small, &number, SMALL_COUNT, &large_report.small_ticks);
  large_report.large_taken = publish(&large, &message, LARGE_COUNT, &large_report.large_ticks);
  (void)rmw_uros_get_statistics(context, &statistics);
  large_report.dropped = statistics.dropped;
  large_report.published = 1;
  while (rmw_uros_flush(context, FLUSH_MS) != RMW_RET_OK) {
    port_sleep_ms(STEP_MS);
  }
  large_report.done = 1;
  for (;;) {
    port_sleep_ms(STEP_MS);
  }
}
