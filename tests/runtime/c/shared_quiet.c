/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Wake-ups of a thread in rclc_executor_spin that has nothing to do, as the system counts them: shared_quiet MS. Prints how
 * often threads of the process went to sleep within that time. Then the main thread publishes once, and sleeps: what follows
 * of it is for the thread with the executor, which ends with the context. The application file is SHARED of
 * test_task_wakes.py; its agent loses that message, and sends a sample when it has it.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit_spinner.h"

enum { SECONDS_AT_MOST = 60 };

int main(int count, char * arguments[])
{
  const std_msgs__msg__Int32 message = {.data = 1};
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_publisher_t publisher;

  CHECK(count == 2);
  spinner_open();
  CHECK(rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK);
  spinner_start();
  (void)printf("%lu\n", spinner_sleeps((uint32_t)strtoul(arguments[1], NULL, 10)));
  CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
  for (uint32_t i = 0; i < (uint32_t)SECONDS_AT_MOST && heard_now() == 0u; ++i) {
    port_sleep_ms(1000); /* it calls nothing of the library */
  }
  CHECK(heard_now() == 1u);
  port_sleep_ms(SPINNER_SETTLED_MS);
  spinner_stop();
  return 0;
}
