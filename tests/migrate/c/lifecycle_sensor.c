/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A sensor with a life cycle, written as programs for rclc are: the services are added one by one, messages of the
 * program are in its memory, and it ends when its node is shut down.
 */
#include <stdio.h>

#include <lifecycle_msgs/msg/state.h>
#include <lifecycle_msgs/msg/transition.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rcl_lifecycle/rcl_lifecycle.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_lifecycle/rclc_lifecycle.h>
#include <std_msgs/msg/int32.h>

#define RCCHECK(call) \
  { \
    const rcl_ret_t code = call; \
    if (code != RCL_RET_OK) { \
      printf("%s: %d %s\n", #call, (int)code, rcl_get_error_string().str); \
      return 1; \
    } \
  }

static rcl_publisher_t readings;
static std_msgs__msg__Int32 reading;
static rclc_lifecycle_node_t sensor;

static void on_timer(rcl_timer_t * timer, int64_t since)
{
  (void)since;
  if (
    timer != NULL &&
    sensor.state_machine->current_state->id == lifecycle_msgs__msg__State__PRIMARY_STATE_ACTIVE) {
    ++reading.data;
    (void)rcl_publish(&readings, &reading, NULL);
  }
}

static int started(void)
{
  printf("configured\n");
  fflush(stdout);
  return RCL_RET_OK;
}

static int switched_on(void)
{
  printf("active\n");
  fflush(stdout);
  return RCL_RET_OK;
}

static int switched_off(void)
{
  return RCL_RET_OK;
}

static int stopped(void)
{
  return RCL_RET_OK;
}

int main(int argc, const char * argv[])
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node;
  rcl_timer_t timer;
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  rcl_lifecycle_state_machine_t states = rcl_lifecycle_get_zero_initialized_state_machine();
  rclc_lifecycle_service_context_t context;

  RCCHECK(rclc_support_init(&support, argc, argv, &allocator));
  RCCHECK(rclc_node_init_default(&node, "sensor", "", &support));
  RCCHECK(rclc_publisher_init_default(
    &readings, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "readings"));
  RCCHECK(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(20), on_timer, true));
  RCCHECK(rclc_make_node_a_lifecycle_node(&sensor, &node, &states, &allocator, true));
  RCCHECK(rclc_executor_init(&executor, &support.context, 4, &allocator));
  RCCHECK(rclc_executor_add_timer(&executor, &timer));
  context.lifecycle_node = &sensor;
  RCCHECK(rclc_lifecycle_init_get_state_server(&context, &executor));
  RCCHECK(rclc_lifecycle_init_get_available_states_server(&context, &executor));
  RCCHECK(rclc_lifecycle_init_change_state_server(&context, &executor));
  RCCHECK(rclc_lifecycle_register_on_configure(&sensor, &started));
  RCCHECK(rclc_lifecycle_register_on_activate(&sensor, &switched_on));
  RCCHECK(rclc_lifecycle_register_on_deactivate(&sensor, &switched_off));
  RCCHECK(rclc_lifecycle_register_on_cleanup(&sensor, &stopped));
  while (states.current_state->id != lifecycle_msgs__msg__State__PRIMARY_STATE_FINALIZED) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10));
  }
  RCCHECK(rclc_executor_fini(&executor));
  RCCHECK(rcl_timer_fini(&timer));
  RCCHECK(rclc_lifecycle_node_fini(&sensor, &allocator));
  RCCHECK(rcl_publisher_fini(&readings, &node));
  RCCHECK(rcl_node_fini(&node));
  RCCHECK(rclc_support_fini(&support));
  return 0;
}
