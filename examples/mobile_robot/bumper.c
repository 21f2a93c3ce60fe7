/* SPDX-License-Identifier: Apache-2.0 */
/* A bumper: a contact is a force above `threshold`, which the mode sets. Its sensor here is a wave. */
#include "board.h"

#include <std_msgs/msg/bool.h>

enum { POLL_MS = 20, PERIOD = 100, STRONGEST = 60 };

static const board_t board = {"bumper", bumper_parameters_declare, &bumper_modes};

static rcl_publisher_t publisher;
static rcl_timer_t timer;
static std_msgs__msg__Bool contact;
static int64_t polls;

static void on_poll(rcl_timer_t * due, int64_t last_call_time)
{
  int64_t threshold = 0;
  int64_t force = polls * STRONGEST / PERIOD; /* in N */

  RCLC_UNUSED(due);
  RCLC_UNUSED(last_call_time);
  polls = (polls + 1) % PERIOD;
  if (rclc_parameter_get_int(&board_parameters, "threshold", &threshold) == RCL_RET_OK) {
    contact.data = force > threshold;
  }
  (void)rcl_publish(&publisher, &contact, NULL); /* the statistics count what is dropped */
}

int main(void)
{
  bool begun = board_begin(&board, 1);

  begun = begun && rclc_publisher_init_default(
                     &publisher, &board_node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Bool),
                     "~/contact") == RCL_RET_OK;
  begun = begun && rclc_timer_init_default2(&timer, &board_support, RCL_MS_TO_NS(POLL_MS), on_poll, true) ==
                     RCL_RET_OK;
  begun = begun && rclc_executor_add_timer(&board_executor, &timer) == RCL_RET_OK;
  if (begun) {
    board_run();
  }
  return begun ? 0 : 1;
}
