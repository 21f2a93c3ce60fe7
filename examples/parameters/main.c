/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A lamp whose brightness goes up and down, times the parameter `gain`. A callback refuses a color that the lamp does not
 * have. What happens is logged, on /rosout and on the console; a report goes to /diagnostics once a second.
 */
#include "../example.h"

#include <diagnostic_msgs/msg/diagnostic_array.h>
#include <diagnostic_msgs/msg/diagnostic_status.h>
#include <diagnostic_msgs/msg/key_value.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_parameter/declared_parameters.h>
#include <rclc_parameter/rclc_parameter.h>
#include <rcutils/logging_macros.h>
#include <rosidl_runtime_c/string_functions.h>
#include <std_msgs/msg/float64.h>

#include <string.h>

enum { STEPS = 10, HANDLES = 2 + RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t brightness_publisher;
static rcl_publisher_t diagnostics_publisher;
static rcl_timer_t tick_timer;
static rcl_timer_t report_timer;
static rclc_parameter_server_t parameters;
static dimmer_parameters_t values; /* not part of rclc: microros-gen declares what microros.yaml lists */
static rclc_executor_t executor;
static std_msgs__msg__Float64 brightness;
static diagnostic_msgs__msg__DiagnosticArray diagnostics;
static int step;
static int changes;

/* Called before a value changes; false refuses it. */
static bool on_parameter(const Parameter * old_param, const Parameter * new_param, void * context)
{
  RCLC_UNUSED(context);
  if (old_param == NULL || new_param == NULL) {
    return false; /* neither new parameters nor fewer */
  }
  if (strcmp(new_param->name.data, "color") == 0) {
    const char * const color = new_param->value.string_value.data;

    if (strcmp(color, "white") != 0 && strcmp(color, "red") != 0) {
      RCUTILS_LOG_WARN_NAMED("dimmer", "the color %s is not available", color);
      return false;
    }
  }
  ++changes;
  RCUTILS_LOG_INFO_NAMED("dimmer", "%s changes", new_param->name.data);
  return true;
}

/* Goes up and down: 0, 1, … 5, 4, … 1, 0, each times the gain. */
static void on_tick(rcl_timer_t * timer, int64_t last_call_time)
{
  RCLC_UNUSED(timer);
  RCLC_UNUSED(last_call_time);
  (void)dimmer_parameters_update(&values, &parameters);
  step = (step + 1) % STEPS;
  brightness.data = values.gain * (double)(step <= STEPS / 2 ? step : STEPS - step);
  (void)example_tell(rcl_publish(&brightness_publisher, &brightness, NULL), "publish");
}

static void on_report(rcl_timer_t * timer, int64_t last_call_time)
{
  diagnostic_msgs__msg__DiagnosticStatus * const status = &diagnostics.status.data[0];
  char text[16];

  RCLC_UNUSED(timer);
  RCLC_UNUSED(last_call_time);
  (void)snprintf(text, sizeof(text), "%d", changes);
  (void)rosidl_runtime_c__String__assign(&status->values.data[0].value, text);
  (void)example_tell(rcl_publish(&diagnostics_publisher, &diagnostics, NULL), "report");
}

/* The texts that stay the same. The sequences have room for one status with one value. */
static bool fill_diagnostics(void)
{
  diagnostic_msgs__msg__DiagnosticStatus * status;

  if (
    !diagnostic_msgs__msg__DiagnosticArray__init(&diagnostics) ||
    !diagnostic_msgs__msg__DiagnosticStatus__Sequence__init(&diagnostics.status, 1)) {
    return false;
  }
  status = &diagnostics.status.data[0];
  status->level = diagnostic_msgs__msg__DiagnosticStatus__OK;
  return rosidl_runtime_c__String__assign(&status->name, "dimmer") &&
         rosidl_runtime_c__String__assign(&status->message, "the lamp is on") &&
         diagnostic_msgs__msg__KeyValue__Sequence__init(&status->values, 1) &&
         rosidl_runtime_c__String__assign(&status->values.data[0].key, "changes");
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  if (!fill_diagnostics()) {
    (void)fprintf(stderr, "the diagnostics do not fit their limits\n");
    return EXIT_FAILURE;
  }
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "dimmer", "", &support), "node");
  example_check(
    rclc_publisher_init_default(
      &brightness_publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Float64), "brightness"),
    "brightness");
  example_check(
    rclc_publisher_init_default(
      &diagnostics_publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(diagnostic_msgs, msg, DiagnosticArray),
      "/diagnostics"),
    "diagnostics");
  example_check(rclc_timer_init_default2(&tick_timer, &support, RCL_MS_TO_NS(100), on_tick, true), "tick");
  example_check(
    rclc_timer_init_default2(&report_timer, &support, RCL_MS_TO_NS(1000), on_report, true), "report");
  example_check(rclc_parameter_server_init_default(&parameters, &node), "parameters");
  example_check(dimmer_parameters_declare(&parameters), "declared parameters");

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, HANDLES, &allocator), "executor");
  example_check(rclc_executor_add_parameter_server(&executor, &parameters, on_parameter), "add parameters");
  example_check(rclc_executor_add_timer(&executor, &tick_timer), "add tick");
  example_check(rclc_executor_add_timer(&executor, &report_timer), "add report");
  RCUTILS_LOG_INFO_NAMED("dimmer", "the lamp is on");
  while (example_runs()) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rclc_parameter_server_fini(&parameters, &node), "end of the parameters");
  example_check(rcl_timer_fini(&report_timer), "end of report");
  example_check(rcl_timer_fini(&tick_timer), "end of tick");
  example_check(rcl_publisher_fini(&diagnostics_publisher, &node), "end of diagnostics");
  example_check(rcl_publisher_fini(&brightness_publisher, &node), "end of brightness");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
