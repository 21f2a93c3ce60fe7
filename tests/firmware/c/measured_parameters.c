/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The measured parameter server: opens a session and a node; the server with its four parameters; then answers requests of
 * get_parameters and of set_parameters, whose event is published; then does the same by calls. Each is done several times:
 * the last one takes in what the agent said to the one before.
 */
#include "measured.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_parameter/declared_parameters.h>

/* Indexes of objects: the publisher of events is the first, the services follow by name. */
enum { GET_PARAMETERS = 3, SET_PARAMETERS = 5 };
enum { TIMES = 8, VALUE_AT = 24 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rclc_parameter_server_t server;

static bool on_parameter(const Parameter * old_param, const Parameter * new_param, void * context)
{
  (void)old_param;
  (void)new_param;
  (void)context;
  return true;
}

static void check(bool holds)
{
  if (!holds) {
    finish();
  }
}

static void open_server(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_parameter_server_init_default(&server, &node) == RCL_RET_OK);
  check(arm_device_parameters_declare(&server) == RCL_RET_OK);
  check(
    rclc_executor_init(&executor, &support.context, RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES, &allocator) ==
    RCL_RET_OK);
  check(rclc_executor_add_parameter_server(&executor, &server, on_parameter) == RCL_RET_OK);
}

/* Receives what waits, without a request among it. */
static void settle(void)
{
  for (int32_t i = 0; i < TIMES; ++i) {
    check(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  }
}

/* Lets the executor run until so many samples were written. */
static void answer_until(uint32_t count)
{
  while (written < count) {
    check(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  }
}

static void get_by_service(void)
{
  static const uint8_t request[20] = {
    1, 0, 0, 0, 12, 0, 0, 0, 'm', 'o', 't', 'o', 'r', '.', 's', 't', 'e', 'p', 's', 0};

  answer_request(GET_PARAMETERS, request, sizeof(request));
  mark();
  answer_until(written + 1u);
  mark();
  settle();
}

/* One parameter: name, type, a bool, the integer, a double, an empty string and five empty arrays. */
static void set_by_service(uint8_t value)
{
  uint8_t request[68] = {
    1, 0, 0, 0, 12, 0, 0, 0, 'm', 'o', 't', 'o', 'r', '.', 's', 't', 'e', 'p', 's', 0, 2};

  request[VALUE_AT] = value;
  request[40] = 1;
  answer_request(SET_PARAMETERS, request, sizeof(request));
  mark();
  answer_until(written + 2u);
  mark();
  settle();
}

static void call(int64_t value)
{
  int64_t found = 0;

  mark();
  check(rclc_parameter_set_int(&server, "motor.steps", value) == RCL_RET_OK);
  mark();
  settle();
  mark();
  check(rclc_parameter_get_int(&server, "motor.steps", &found) == RCL_RET_OK);
  mark();
  check(found == value);
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  int64_t steps = 0;

  mark();
  mark(); /* the distance of these two is the cost of a mark */
  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  check(rclc_node_init_default(&node, "device", "arm", &support) == RCL_RET_OK);
  mark();
  open_server();
  mark();
  settle();
  for (uint8_t i = 0; i < TIMES; ++i) {
    get_by_service();
    set_by_service((uint8_t)(2 * i));
    check(rclc_parameter_get_int(&server, "motor.steps", &steps) == RCL_RET_OK);
    check(steps == 2 * i);
  }
  for (int32_t i = 0; i < TIMES; ++i) {
    call(i);
  }
  mark();
  finish();
  return 0;
}
