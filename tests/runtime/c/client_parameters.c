/* SPDX-License-Identifier: Apache-2.0 */
/* A parameter server and a publisher in the hands of the test: one call for each line of standard input. */
#include "fake_no_wait.h"
#include "fake_program.h"

#include <microros_config.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#if MICROROS_PARAMETERS_HELD
#include <rclc_parameter/held_parameters.h>
#endif
#include <rclc_parameter/rclc_parameter.h>
#ifdef PARAMETERS_DECLARED
#include <rclc_parameter/declared_parameters.h>
#endif
#ifdef PARAMETERS_STORED
#include <rclc_parameter/parameter_storage.h>
#endif
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rclc_executor_t executor;
static rclc_parameter_server_t server;
static rcl_allocator_t allocator;

static rcl_ret_t start(void)
{
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "device", "arm", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count");
  }
  return result;
}

static rcl_ret_t open_server(bool allows_undeclared)
{
  const rclc_parameter_options_t options = {true, MICROROS_PARAMETERS_MAX, true, false};
  rcl_ret_t result = allows_undeclared
                       ? rclc_parameter_server_init_with_option(&server, &node, &options)
                       : rclc_parameter_server_init_default(&server, &node);

  if (result == RCL_RET_OK) {
    result =
      rclc_executor_init(&executor, &support.context, RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES, &allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_parameter_server(&executor, &server, NULL);
  }
  return result;
}

#ifdef PARAMETERS_STORED
/* restart NAME: the program begins with a parameter and the values that are saved */
static rcl_ret_t restart(const char * argument)
{
  char name[64] = ""; /* the line's memory is used again when the agent answers */
  size_t skipped = 0;
  rcl_ret_t result;

  (void)strncpy(name, argument, sizeof(name) - 1u);
  result = rclc_parameter_server_init_default(&server, &node);

  if (result == RCL_RET_OK) {
    result = rclc_add_parameter(&server, name, RCLC_PARAMETER_INT);
  }
  if (result == RCL_RET_OK) {
    result = rclc_parameter_storage_load(&server, 0, &skipped);
    printf("skipped %zu\n", skipped);
  }
  if (result == RCL_RET_OK) {
    result =
      rclc_executor_init(&executor, &support.context, RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES, &allocator);
  }
  return result == RCL_RET_OK ? rclc_executor_add_parameter_server(&executor, &server, NULL) : result;
}
#endif

static rcl_ret_t close_server(void)
{
  const rcl_ret_t result = rclc_executor_fini(&executor);

  return result == RCL_RET_OK ? rclc_parameter_server_fini(&server, &node) : result;
}

static rcl_ret_t publish(void)
{
  static std_msgs__msg__Int32 message;
  const rcl_ret_t result = rcl_publish(&publisher, &message, NULL);

  if (result == RCL_RET_OK) {
    ++message.data;
  }
  return result;
}

static rcl_ret_t get(const char * name)
{
  int64_t value = 0;
  const rcl_ret_t result = rclc_parameter_get_int(&server, name, &value);

  printf("value %" PRId64 "\n", value);
  return result;
}

#if MICROROS_PARAMETER_STRING_SIZE > 0u
static rcl_ret_t get_text(const char * name)
{
  const char * value = NULL;
  const rcl_ret_t result = rclc_parameter_get_string(&server, name, &value);

  printf("text %s\n", value == NULL ? "none" : value);
  return result;
}

/* text NAME; text NAME VALUE; text NAME <SIZE: a constraint; text NAME +: adds it */
static rcl_ret_t text(char * name)
{
  char * value = strchr(name, ' ');

  if (value == NULL) {
    return get_text(name);
  }
  *value = '\0';
  ++value;
  if (value[0] == '+') {
    return rclc_add_parameter(&server, name, RCLC_PARAMETER_STRING);
  }
  return value[0] == '<' ? rclc_add_parameter_constraint_string(&server, name, (size_t)atoi(&value[1]))
                         : rclc_parameter_set_string(&server, name, value);
}
#endif

/* write NAME VALUE */
static rcl_ret_t write(const char * arguments)
{
  char name[64] = "";
  int value = 0;

  return sscanf(arguments, "%63s %d", name, &value) == 2 ? rclc_parameter_set_int(&server, name, value) : -1;
}

#if MICROROS_PARAMETERS_HELD
static rcl_ret_t check_held(void)
{
  printf("overruled %" PRIu32 "\n", rclc_parameter_count_overruled(&server));
  return rclc_parameter_check_held(&server);
}
#endif

#if MICROROS_PARAMETER_ONE_OF
static rcl_ret_t enumerate(const char * name)
{
  static const int64_t values[] = {0, 5};

  return rclc_add_parameter_constraint_one_of_int(&server, name, values, 2);
}
#endif

#ifdef PARAMETERS_DECLARED
/* What the application file declares of the node /arm/device: `steps` among others. */
static rcl_ret_t update(void)
{
  static arm_device_parameters_t values;
  const bool changed = arm_device_parameters_update(&values, &server);

  printf("changed %d steps %" PRId64 "\n", (int)changed, values.steps);
  return RCL_RET_OK;
}

/* Says something else of a parameter than its declaration. */
static rcl_ret_t override(const char * name)
{
  const rcl_ret_t result = rclc_add_parameter_description(&server, name, "other", "words");

  return result == RCL_RET_OK ? rclc_add_parameter_constraint_integer(&server, name, 0, 5, 0) : result;
}
#endif

static rcl_ret_t print_statistics(void)
{
  rmw_uros_statistics_t s;
  const rcl_ret_t result = rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &s);

  printf(
    "statistics malformed=%" PRIu32 " dropped=%" PRIu32 " reconnects=%" PRIu32 "\n", s.malformed, s.dropped,
    s.reconnects);
  return result;
}

static rcl_ret_t call(const char * line)
{
  const char * space = strchr(line, ' ');
  const char * name = space != NULL ? &space[1] : "";

  switch (line[0]) {
#if MICROROS_PARAMETER_STRING_SIZE > 0u
    case 't': { /* text */
      char copy[64] = "";

      (void)strncpy(copy, name, sizeof(copy) - 1u);
      return text(copy);
    }
#endif
    case 'w': /* write NAME VALUE */
      return write(name);
    case 'b': /* bound NAME */
      return rclc_add_parameter_constraint_integer(&server, name, 0, 5, 0);
#if MICROROS_PARAMETER_ONE_OF
    case 'e': /* enumerate NAME */
      return enumerate(name);
#endif
#if MICROROS_PARAMETERS_HELD
    case 'h': /* held */
      return check_held();
#endif
#ifdef PARAMETERS_DECLARED
    case 'D': /* Declare */
      return arm_device_parameters_declare(&server);
    case 'O': /* Override NAME */
      return override(name);
    case 'U': /* Update */
      return update();
#endif
#ifdef PARAMETERS_STORED
    case 'k': /* keep */
      return rclc_parameter_storage_save(&server, 0);
    case 'l': /* load */
      return rclc_parameter_storage_load(&server, 0, NULL);
    case 'r': /* restart NAME */
      return restart(name);
#endif
    case 'i': /* init */
      return start();
    case 'o': /* open */
      return open_server(false);
    case 'f': /* free: open for parameters that are not declared */
      return open_server(true);
    case 'a': /* add NAME */
      return rclc_add_parameter(&server, name, RCLC_PARAMETER_INT);
    case 'd': /* delete NAME */
      return rclc_delete_parameter(&server, name);
    case 'g': /* get NAME */
      return get(name);
    case 'p': /* publish */
      return publish();
    case 'c': /* close */
      return close_server();
    case 's':
      return strcmp(line, "statistics") == 0 ? print_statistics() : rclc_executor_spin_some(&executor, 0);
    default:
      return -1;
  }
}

static void work(char * line)
{
  report_result(call(line));
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  return run_calls(work);
}
