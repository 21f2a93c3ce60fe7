/* SPDX-License-Identifier: Apache-2.0 */
/* A node with modes in the hands of the test: one call for each line of standard input. */
#include "fake_no_wait.h"
#include "fake_program.h"
#include "retained_file.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_modes/declared_modes.h>
#include <rclc_parameter/declared_parameters.h>
#include <rmw_microros/rmw_microros.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static rcl_lifecycle_state_machine_t machine;
static rclc_lifecycle_node_t lifecycle;
static rclc_lifecycle_service_context_t context = {&lifecycle};
static rclc_parameter_server_t parameters;
static rclc_modes_t modes;

static int outcomes[8];      /* of transitions, by their ids */
static int failures[8];      /* how many more times; then they succeed */
static bool refuses_modes;   /* what the callbacks answer */
static const char * refused; /* a parameter; NULL: none */
static bool nests;           /* the callbacks try to change the mode themselves */
static int asked;            /* parameters */
static int mode_calls;
static rcl_ret_t nested;

static int transition(int id)
{
  if (failures[id] > 0) {
    --failures[id];
    return outcomes[id];
  }
  return RCL_RET_OK;
}

static int on_activate(void)
{
  return transition(lifecycle_msgs__msg__Transition__TRANSITION_ACTIVATE);
}

static int on_deactivate(void)
{
  return transition(lifecycle_msgs__msg__Transition__TRANSITION_DEACTIVATE);
}

static int on_error(void)
{
  return RCL_RET_OK;
}

static bool on_parameter(const Parameter * old_param, const Parameter * new_param, void * unused)
{
  (void)new_param;
  (void)unused;
  ++asked;
  if (nests) {
    nested = rclc_modes_change(&modes, 0);
    rcl_reset_error();
  }
  return refused == NULL || old_param == NULL || strcmp(old_param->name.data, refused) != 0;
}

static bool on_mode(uint8_t start_mode, uint8_t goal_mode, void * of_modes)
{
  ++mode_calls;
  printf("asked %s %s\n", rclc_modes_name(of_modes, start_mode), rclc_modes_name(of_modes, goal_mode));
  if (nests) {
    nested = rclc_modes_reconfigure(of_modes, 0);
    rcl_reset_error();
  }
  return !refuses_modes;
}

static rcl_ret_t init(void)
{
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "device", "arm", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_init(&executor, &support.context, 12, &allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_parameter_server_init_default(&parameters, &node);
  }
  if (result == RCL_RET_OK) {
    result = arm_device_parameters_declare(&parameters);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_parameter_server_with_context(&executor, &parameters, on_parameter, NULL);
  }
  if (result == RCL_RET_OK) {
    result = rclc_make_node_a_lifecycle_node(&lifecycle, &node, &machine, &allocator, true);
  }
  if (result == RCL_RET_OK) {
    result = rclc_lifecycle_init_change_state_server(&context, &executor);
  }
  if (result == RCL_RET_OK) {
    result = rclc_lifecycle_init_get_state_server(&context, &executor);
  }
  if (result == RCL_RET_OK) {
    result = rclc_lifecycle_init_get_available_states_server(&context, &executor);
  }
  if (result == RCL_RET_OK) {
    result = rclc_lifecycle_register_on_activate(&lifecycle, on_activate);
  }
  if (result == RCL_RET_OK) {
    result = rclc_lifecycle_register_on_deactivate(&lifecycle, on_deactivate);
  }
  return result == RCL_RET_OK
           ? rclc_lifecycle_register_callback(
               &lifecycle, lifecycle_msgs__msg__State__TRANSITION_STATE_ERRORPROCESSING, on_error)
           : result;
}

static rcl_ret_t make(void)
{
  const rcl_ret_t result = rclc_modes_init(&modes, &arm_device_modes, &lifecycle, &parameters);

  return result == RCL_RET_OK ? rclc_executor_add_modes(&executor, &modes, on_mode, &modes) : result;
}

static rcl_ret_t show(void)
{
  const char * name = rclc_modes_name(&modes, rclc_modes_get(&modes));
  const char * label = NULL;
  const double * path = NULL;
  double speed = 0.0;
  double limit = 0.0;
  int64_t gain = 0;
  size_t count = 0;
  rcl_ret_t result = rclc_parameter_get_double(&parameters, "speed", &speed);

  if (result == RCL_RET_OK) {
    result = rclc_parameter_get_double(&parameters, "limit", &limit);
  }
  if (result == RCL_RET_OK) {
    result = rclc_parameter_get_int(&parameters, "gains.p", &gain);
  }
  if (result == RCL_RET_OK) {
    result = rclc_parameter_get_string(&parameters, "label", &label);
  }
  if (result == RCL_RET_OK) {
    result = rclc_parameter_get_double_array(&parameters, "path", &path, &count);
  }
  if (result == RCL_RET_OK) {
    printf(
      "shown %s %s %.2f %" PRId64 " %s %.2f", machine.current_state->label, name != NULL ? name : "-", speed,
      gain, label, limit);
    for (size_t i = 0; i < count; ++i) {
      printf(" %.1f", path[i]);
    }
    printf("\n");
  }
  return result;
}

static rcl_ret_t end(void)
{
  rcl_ret_t result = rclc_modes_fini(&modes);

  if (result == RCL_RET_OK) {
    result = rclc_lifecycle_node_fini(&lifecycle, &allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_parameter_server_fini(&parameters, &node);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_fini(&executor);
  }
  if (result == RCL_RET_OK) {
    result = rcl_node_fini(&node);
  }
  return result == RCL_RET_OK ? rclc_support_fini(&support) : result;
}

static rcl_ret_t set(const char * name, const char * value)
{
  return rclc_parameter_set_double(&parameters, name, strtod(value, NULL));
}

/* "fail 3 1 2": transition 3 returns 1, two times. */
static rcl_ret_t fail(int id, int outcome, int times)
{
  outcomes[id] = outcome;
  failures[id] = times;
  return RCL_RET_OK;
}

static rcl_ret_t refuse(const char * what)
{
  static char name[32];

  refuses_modes = strcmp(what, "modes") == 0;
  (void)strncpy(name, what, sizeof(name) - 1u);
  refused = refuses_modes || strcmp(what, "nothing") == 0 ? NULL : name;
  return RCL_RET_OK;
}

static rcl_ret_t count_calls(void)
{
  printf("calls %d %d nested %d\n", mode_calls, asked, (int)nested);
  mode_calls = 0;
  asked = 0;
  nested = 0;
  return RCL_RET_OK;
}

static rcl_ret_t call(char * line)
{
  const char * word = strtok(line, " ");
  const char * first = strtok(NULL, " ");
  const char * second = strtok(NULL, " ");
  const char * third = strtok(NULL, " ");

  if (strcmp(word, "init") == 0) {
    return init();
  }
  if (strcmp(word, "make") == 0) {
    return make();
  }
  if (strcmp(word, "state") == 0) {
    return rclc_lifecycle_change_state(&lifecycle, (unsigned int)atoi(first), true);
  }
  if (strcmp(word, "mode") == 0) {
    return rclc_modes_change(&modes, rclc_modes_find(&modes, first));
  }
  if (strcmp(word, "reconfigure") == 0) {
    return rclc_modes_reconfigure(&modes, rclc_modes_find(&modes, first));
  }
  if (strcmp(word, "show") == 0) {
    return show();
  }
  if (strcmp(word, "set") == 0) {
    return set(first, second);
  }
  if (strcmp(word, "delete") == 0) {
    return rclc_delete_parameter(&parameters, first);
  }
  if (strcmp(word, "shorten") == 0) {
    return rclc_add_parameter_constraint_string(&parameters, first, (size_t)atoi(second));
  }
  if (strcmp(word, "refuse") == 0) {
    return refuse(first);
  }
  if (strcmp(word, "nest") == 0) {
    nests = true;
    return RCL_RET_OK;
  }
  if (strcmp(word, "fail") == 0) {
    return fail(atoi(first), atoi(second), atoi(third));
  }
  if (strcmp(word, "calls") == 0) {
    return count_calls();
  }
  if (strcmp(word, "sleep") == 0) {
    return go_to_sleep(&support, first);
  }
  if (strcmp(word, "wake") == 0) {
    return wake_up(first);
  }
  if (strcmp(word, "end") == 0) {
    return end();
  }
  return rclc_executor_spin_some(&executor, 0);
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
