/* SPDX-License-Identifier: Apache-2.0 */
/* A wheel: its motor approaches `max_speed`, which the mode sets, while the node is active. */
#include "board.h"

#include <std_msgs/msg/float64.h>

enum { CONTROL_MS = 100 };

static const double STEP = 0.05; /* m/s in a period */

static const board_t board = {WHEEL_NAME, WHEEL_DECLARE, &WHEEL_MODES};

static rcl_publisher_t publisher;
static rcl_timer_t timer;
static std_msgs__msg__Float64 speed;

static void on_control(rcl_timer_t * due, int64_t last_call_time)
{
  double most = 0.0;

  RCLC_UNUSED(due);
  RCLC_UNUSED(last_call_time);
  if (rclc_parameter_get_double(&board_parameters, "max_speed", &most) == RCL_RET_OK) {
    speed.data = speed.data + STEP < most ? speed.data + STEP : most;
  }
  (void)rcl_publish(&publisher, &speed, NULL); /* the statistics count what is dropped */
}

static int on_deactivate(void)
{
  speed.data = 0.0;
  return RCL_RET_OK;
}

int main(void)
{
  bool begun = board_begin(&board, 1);

  begun = begun && rclc_publisher_init_default(
                     &publisher, &board_node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Float64),
                     "~/speed") == RCL_RET_OK;
  begun = begun && rclc_timer_init_default2(
                     &timer, &board_support, RCL_MS_TO_NS(CONTROL_MS), on_control, true) == RCL_RET_OK;
  begun = begun && rclc_executor_add_timer(&board_executor, &timer) == RCL_RET_OK;
  begun = begun && rclc_lifecycle_register_on_deactivate(&board_lifecycle, on_deactivate) == RCL_RET_OK;
  if (begun) {
    board_run();
  }
  return begun ? 0 : 1;
}
