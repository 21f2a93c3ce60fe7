/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Wake-ups of a thread in rclc_executor_spin that has nothing to do, as the system counts them: shared_quiet MS. Prints how
 * often threads of the process went to sleep within that time. Then the main thread publishes once, and sleeps: what follows
 * of it is for the thread with the executor, which ends with the context. The application file is SHARED of
 * test_task_wakes.py; its agent loses that message, and sends a sample when it has it.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit.h"
#include "unit_heard.h"
#include "unit_sleeps.h"

#include <microros/port.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <pthread.h>

enum { SETTLED_MS = 2500, SECONDS_AT_MOST = 60 };

static rclc_executor_t executor;

static void * spin(void * argument)
{
  (void)rclc_executor_spin(&executor);
  return argument;
}

int main(int count, char * arguments[])
{
  static std_msgs__msg__Int32 sample;
  const std_msgs__msg__Int32 message = {.data = 1};
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_publisher_t publisher;
  rcl_subscription_t subscription;
  pthread_t thread;
  unsigned long before;

  CHECK(count == 2);
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscription, &node, type, "target") == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&executor, &subscription, &sample, on_sample, ON_NEW_DATA) == RCL_RET_OK);
  CHECK(pthread_create(&thread, NULL, spin, NULL) == 0);
  port_sleep_ms(SETTLED_MS);
  before = sleeps();
  port_sleep_ms((uint32_t)strtoul(arguments[1], NULL, 10));
  (void)printf("%lu\n", sleeps() - before);
  CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
  for (uint32_t i = 0; i < (uint32_t)SECONDS_AT_MOST && heard_now() == 0u; ++i) {
    port_sleep_ms(1000); /* it calls nothing of the library */
  }
  CHECK(heard_now() == 1u);
  port_sleep_ms(SETTLED_MS);
  CHECK(rcl_shutdown(&support.context) == RCL_RET_OK);
  CHECK(pthread_join(thread, NULL) == 0); /* the executor notices that its context has ended */
  return 0;
}
