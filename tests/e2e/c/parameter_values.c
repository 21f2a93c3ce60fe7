/* SPDX-License-Identifier: Apache-2.0 */
/* The struct of declared parameters, without an agent: what it has at the start, after a change, and without one. */
#include <rclc_parameter/declared_parameters.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static rclc_parameter_server_t server;
static arm_device_parameters_t values;

static void check(rcl_ret_t result)
{
  if (result != RCL_RET_OK) {
    abort();
  }
}

static void show(void)
{
  const bool changed = arm_device_parameters_update(&values, &server);

  if (changed != values.changed) {
    abort();
  }
  (void)printf(
    "%d on=%d motor_gain=%g steps=%" PRId64 " int_=%" PRId64 " label=%s", changed, values.on,
    values.motor_gain, values.steps, values.int_, values.label);
  for (size_t i = 0; i < values.integers.size; ++i) {
    (void)printf(" %" PRId64, values.integers.data[i]);
  }
  for (size_t i = 0; i < values.bytes.size; ++i) {
    (void)printf(" %d", values.bytes.data[i]);
  }
  for (size_t i = 0; i < values.names.size; ++i) {
    (void)printf(" '%s'", values.names.data[i]);
  }
  (void)printf("\n");
}

int main(void)
{
  static const int64_t integers[] = {4, 5, 6};
  static const char * const names[] = {"", "second"};

  server.max_params = MICROROS_PARAMETERS_MAX;
  check(arm_device_parameters_declare(&server));
  show();
  show();
  check(rclc_parameter_set_double(&server, "motor.gain", -1.5));
  check(rclc_parameter_set_string(&server, "label", "right"));
  check(rclc_parameter_set_int_array(&server, "integers", integers, 3));
  check(rclc_parameter_set_string_array(&server, "names", names, 2));
  show();
  check(rclc_parameter_set_byte_array(&server, "bytes", NULL, 0));
  check(rclc_delete_parameter(&server, "steps"));
  show();
  show();
  return 0;
}
