/* SPDX-License-Identifier: Apache-2.0 */
/* A parameter server with four parameters, as programs for rclc write it. Ends when motor.steps becomes its largest value. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_parameter/rclc_parameter.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS_MAX = 120, STEPS_VETOED = 66, STEPS_SEEN = 20 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rclc_parameter_server_t server;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %d %s\n", what, (int)result, rcl_get_error_string().str);
    exit(1);
  }
}

static bool on_parameter_changed(const Parameter * old_param, const Parameter * new_param, void * context)
{
  int * changes = context;
  const Parameter * shown = new_param != NULL ? new_param : old_param;

  ++*changes;
  /* The server cannot be changed here. */
  if (rclc_parameter_set_bool(&server, "enabled", true) != RCLC_PARAMETER_DISABLED_ON_CALLBACK) {
    return false;
  }
  rcl_reset_error();
  (void)printf(
    "%s %s", old_param == NULL ? "new" : (new_param == NULL ? "deleted" : "changed"), shown->name.data);
  switch (shown->value.type) {
    case RCLC_PARAMETER_BOOL:
      (void)printf(" %d\n", shown->value.bool_value);
      break;
    case RCLC_PARAMETER_INT:
      (void)printf(" %ld\n", (long)shown->value.integer_value);
      break;
    default:
      (void)printf(" %g\n", shown->value.double_value);
      break;
  }
  (void)fflush(stdout);
  return shown->value.type != RCLC_PARAMETER_INT || shown->value.integer_value != STEPS_VETOED;
}

#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
static void add_arrays(void)
{
  static const uint8_t bytes[] = {0, 255};
  static const bool bools[] = {true, false, true};
  static const int64_t integers[] = {INT64_MIN, -1, INT64_MAX};
  static const double doubles[] = {0.5};
  static const char * const strings[] = {"left", "", "right"};

  check(rclc_add_parameter(&server, "bytes", RCLC_PARAMETER_BYTE_ARRAY), "add");
  check(rclc_add_parameter(&server, "bools", RCLC_PARAMETER_BOOL_ARRAY), "add");
  check(rclc_add_parameter(&server, "integers", RCLC_PARAMETER_INT_ARRAY), "add");
  check(rclc_add_parameter(&server, "doubles", RCLC_PARAMETER_DOUBLE_ARRAY), "add");
  check(rclc_add_parameter(&server, "strings", RCLC_PARAMETER_STRING_ARRAY), "add");
  check(rclc_parameter_set_byte_array(&server, "bytes", bytes, 2), "set");
  check(rclc_parameter_set_bool_array(&server, "bools", bools, 3), "set");
  check(rclc_parameter_set_int_array(&server, "integers", integers, 3), "set");
  check(rclc_parameter_set_double_array(&server, "doubles", doubles, 1), "set");
  check(rclc_parameter_set_string_array(&server, "strings", strings, 3), "set");
  check(rclc_add_parameter_constraint_array(&server, "bytes", 4), "size");
  check(rclc_add_parameter_constraint_array(&server, "bools", 4), "size");
  check(rclc_add_parameter_constraint_array(&server, "integers", 4), "size");
  check(rclc_add_parameter_constraint_array(&server, "doubles", 2), "size");
}
#endif

#if MICROROS_PARAMETER_ONE_OF
static void add_lists_of_values(void)
{
  static const int64_t modes[] = {0, 5};
  static const double rates[] = {0.0, 0.1};
  static const char * const sides[] = {"", "left"};

  check(rclc_add_parameter(&server, "mode", RCLC_PARAMETER_INT), "add");
  check(rclc_add_parameter(&server, "rate", RCLC_PARAMETER_DOUBLE), "add");
  check(rclc_add_parameter(&server, "side", RCLC_PARAMETER_STRING), "add");
  check(rclc_add_parameter_constraint_one_of_int(&server, "mode", modes, 2), "values");
  check(rclc_add_parameter_constraint_one_of_double(&server, "rate", rates, 2), "values");
  check(rclc_add_parameter_constraint_one_of_string(&server, "side", sides, 2), "values");
}
#endif

static void add_parameters(void)
{
  check(rclc_add_parameter(&server, "enabled", RCLC_PARAMETER_BOOL), "add");
  check(rclc_add_parameter(&server, "motor.steps", RCLC_PARAMETER_INT), "add");
  check(rclc_add_parameter(&server, "motor.limits.gain", RCLC_PARAMETER_DOUBLE), "add");
  check(rclc_add_parameter(&server, "version", RCLC_PARAMETER_DOUBLE), "add");
  check(rclc_parameter_set_int(&server, "motor.steps", 10), "set");
  check(rclc_parameter_set_double(&server, "motor.limits.gain", 0.5), "set");
  check(rclc_parameter_set_double(&server, "version", 1.25), "set");
  check(
    rclc_add_parameter_description(&server, "motor.steps", "Steps in a turn", "only even numbers"),
    "describe");
  check(rclc_add_parameter_constraint_integer(&server, "motor.steps", -10, STEPS_MAX, 2), "range");
  check(rclc_add_parameter_constraint_double(&server, "motor.limits.gain", 0.0, 1.0, 0.1), "range");
  check(rclc_set_parameter_read_only(&server, "version", true), "read only");
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  add_arrays();
#endif
#if MICROROS_PARAMETER_ONE_OF
  add_lists_of_values();
#endif
}

/* Arguments: "undeclared" allows a set request to create parameters. */
int main(int argc, char ** argv)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_parameter_options_t options = {true, MICROROS_PARAMETERS_MAX, false, false};
  int64_t steps = 0;
  int changes = 0;

  options.allow_undeclared_parameters = argc > 1 && strcmp(argv[1], "undeclared") == 0;
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "device", "arm", &support), "node");
  check(rclc_parameter_server_init_with_option(&server, &node, &options), "server");
  check(
    rclc_executor_init(&executor, &support.context, RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES, &allocator),
    "executor");
  add_parameters();
  check(
    rclc_executor_add_parameter_server_with_context(&executor, &server, on_parameter_changed, &changes),
    "add server");
  (void)printf("ready\n");
  (void)fflush(stdout);
  while (steps != STEPS_MAX) {
    if (rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)) != RCL_RET_OK) {
      (void)printf("refused %s\n", rcl_get_error_string().str);
      (void)fflush(stdout);
      rcl_reset_error();
    }
    check(rclc_parameter_get_int(&server, "motor.steps", &steps), "get");
  }
  for (int i = 0; i < STEPS_SEEN; ++i) { /* the last reply has to be acknowledged */
    check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10)), "spin");
  }
  check(rclc_executor_fini(&executor), "executor fini");
  check(rclc_parameter_server_fini(&server, &node), "server fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return changes > 0 ? 0 : 1;
}
