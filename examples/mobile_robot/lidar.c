/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A lidar that turns `rate` times a second, as the mode says. The service ~/unplug removes its sensor, or connects
 * it: without the sensor the node goes to `unconfigured`, and cannot be configured.
 */
#include "board.h"

#include <lifecycle_msgs/msg/state.h>
#include <lifecycle_msgs/msg/transition.h>
#include <std_msgs/msg/float32.h>
#include <std_srvs/srv/set_bool.h>

enum { SCAN_MS = 50, SCANS_IN_A_SECOND = 20 };

static const board_t board = {"lidar", lidar_parameters_declare, &lidar_modes};

static rcl_publisher_t publisher;
static rcl_service_t service;
static rcl_timer_t timer;
static std_msgs__msg__Float32 distance;
static std_srvs__srv__SetBool_Request request;
static std_srvs__srv__SetBool_Response response;
static bool is_unplugged;
static int64_t turned; /* of a whole turn, in units of 1 / SCANS_IN_A_SECOND */

static void on_scan(rcl_timer_t * due, int64_t last_call_time)
{
  int64_t rate = 0;

  RCLC_UNUSED(due);
  RCLC_UNUSED(last_call_time);
  if (rclc_parameter_get_int(&board_parameters, "rate", &rate) == RCL_RET_OK) {
    turned += rate;
  }
  if (turned >= SCANS_IN_A_SECOND) {
    turned -= SCANS_IN_A_SECOND;
    distance.data = 1.5F;
    (void)rcl_publish(&publisher, &distance, NULL); /* the statistics count what is dropped */
  }
}

static int on_configure(void)
{
  return is_unplugged ? RCL_RET_ERROR : RCL_RET_OK;
}

/* Goes from where it is to `unconfigured`; other states have nothing to give up. */
static void give_up(void)
{
  const rcl_lifecycle_state_t * state = board_lifecycle.state_machine->current_state;

  if (state->id == lifecycle_msgs__msg__State__PRIMARY_STATE_ACTIVE) {
    (void)rclc_lifecycle_change_state(
      &board_lifecycle, lifecycle_msgs__msg__Transition__TRANSITION_DEACTIVATE, true);
  }
  state = board_lifecycle.state_machine->current_state;
  if (state->id == lifecycle_msgs__msg__State__PRIMARY_STATE_INACTIVE) {
    (void)rclc_lifecycle_change_state(
      &board_lifecycle, lifecycle_msgs__msg__Transition__TRANSITION_CLEANUP, true);
  }
}

static void on_unplug(const void * request_message, void * response_message)
{
  const std_srvs__srv__SetBool_Request * const asked = request_message;
  std_srvs__srv__SetBool_Response * const answer = response_message;

  is_unplugged = asked->data;
  if (is_unplugged) {
    give_up();
  }
  answer->success = true;
}

int main(void)
{
  bool begun = board_begin(&board, 2);

  begun = begun && rclc_publisher_init_default(
                     &publisher, &board_node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Float32),
                     "~/distance") == RCL_RET_OK;
  begun = begun && rclc_service_init_default(
                     &service, &board_node, ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool),
                     "~/unplug") == RCL_RET_OK;
  begun = begun && rclc_timer_init_default2(&timer, &board_support, RCL_MS_TO_NS(SCAN_MS), on_scan, true) ==
                     RCL_RET_OK;
  begun = begun && rclc_executor_add_timer(&board_executor, &timer) == RCL_RET_OK;
  begun = begun &&
          rclc_executor_add_service(&board_executor, &service, &request, &response, on_unplug) == RCL_RET_OK;
  begun = begun && rclc_lifecycle_register_on_configure(&board_lifecycle, on_configure) == RCL_RET_OK;
  if (begun) {
    board_run();
  }
  return begun ? 0 : 1;
}
