/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A console that takes no line at first: console_wakes MS. A line is dropped. Prints how often the console was tried within MS
 * while it took nothing, how many lines it took after that, and how often threads then went to sleep within MS.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit.h"
#include "unit_heard.h"
#include "unit_sleeps.h"

#include <microros/port.h>
#include <microros/port_console.h>
#include <microros_config.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rcutils/logging_macros.h>
#include <std_msgs/msg/int32.h>

#include <pthread.h>

#ifdef MICROROS_TASKS
#include <microros/tasks.h>
#endif

enum { SETTLED_MS = 2500 };

static rclc_executor_t executor;
static bool takes; /* the lock of the port guards these */
static unsigned tries;
static unsigned taken;

/* Called with the lock of the library, which is that of the port. */
bool port_console_write(const char * line, size_t size)
{
  (void)line;
  (void)size;
  ++tries;
  taken += takes ? 1u : 0u;
  return takes;
}

static unsigned tries_now(bool takes_now)
{
  unsigned count;

  port_lock();
  takes = takes_now;
  count = tries;
  port_unlock();
  return count;
}

#ifndef MICROROS_TASKS
static void * spin(void * argument)
{
  (void)rclc_executor_spin(&executor);
  return argument;
}
#endif

int main(int count, char * arguments[])
{
  static std_msgs__msg__Int32 sample;
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_subscription_t subscription;
  unsigned tried;
  unsigned long before;
  uint32_t ms;

  CHECK(count == 2);
  ms = (uint32_t)strtoul(arguments[1], NULL, 10);
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscription, &node, type, "target") == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&executor, &subscription, &sample, on_sample, ON_NEW_DATA) == RCL_RET_OK);
#ifdef MICROROS_TASKS
  CHECK(rclc_task_set_executor(0, &executor, NULL) == RCL_RET_OK);
  CHECK(rclc_tasks_start() == RCL_RET_OK);
#else
  pthread_t thread;

  CHECK(pthread_create(&thread, NULL, spin, NULL) == 0);
#endif
  port_sleep_ms(SETTLED_MS); /* the wait has begun, and is long */
  tried = tries_now(false);
  RCUTILS_LOG_WARN_NAMED("writer", "dropped");
  port_sleep_ms(ms);
  (void)printf("%u ", tries_now(true) - tried);
  port_sleep_ms(SETTLED_MS);
  before = sleeps();
  port_sleep_ms(ms);
  before = sleeps() - before;
  port_lock();
  (void)printf("%u %lu\n", taken, before);
  port_unlock();
#ifdef MICROROS_TASKS
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
#else
  CHECK(rcl_shutdown(&support.context) == RCL_RET_OK);
  CHECK(pthread_join(thread, NULL) == 0);
#endif
  return 0;
}
