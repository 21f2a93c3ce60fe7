/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A parameter and a service in one executor. After the callback of the last of TIMES changes it prints when each was called, in
 * nanoseconds of the monotonic clock of the machine.
 */
#include <inttypes.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_parameter/declared_parameters.h>
#include <std_srvs/srv/set_bool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { HANDLES = RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES + 1 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_service_t service;
static rclc_executor_t executor;
static rclc_parameter_server_t server;
static int64_t called_ns[TIMES];
static int calls;

static bool on_parameter(const Parameter * old_param, const Parameter * new_param, void * context)
{
  struct timespec now;

  (void)old_param;
  (void)new_param;
  (void)context;
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  if (calls < TIMES) {
    called_ns[calls] = (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
    ++calls;
  }
  return true;
}

static void on_request(const void * request, void * response)
{
  const std_srvs__srv__SetBool_Request * asked = request;
  std_srvs__srv__SetBool_Response * answer = response;

  answer->success = asked->data;
}

static void check(rcl_ret_t result)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    exit(EXIT_FAILURE);
  }
}

int main(void)
{
  static std_srvs__srv__SetBool_Request request;
  static std_srvs__srv__SetBool_Response response;
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_support_init(&support, 0, NULL, &allocator));
  check(rclc_node_init_default(&node, "timed", "parameter_times", &support));
  check(
    rclc_service_init_default(&service, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool), "turn"));
  check(rclc_parameter_server_init_default(&server, &node));
  check(parameter_times_timed_parameters_declare(&server));
  check(rclc_executor_init(&executor, &support.context, HANDLES, &allocator));
  check(rclc_executor_add_service(&executor, &service, &request, &response, on_request));
  check(rclc_executor_add_parameter_server(&executor, &server, on_parameter));
  (void)printf("ready\n");
  (void)fflush(stdout);
  while (calls < TIMES) {
    check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)));
  }
  for (int i = 0; i < 20; ++i) { /* the last reply has to be acknowledged */
    check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10)));
  }
  for (int i = 0; i < TIMES; ++i) {
    (void)printf("%" PRId64 "\n", called_ns[i]);
  }
  check(rclc_parameter_server_fini(&server, &node));
  check(rcl_service_fini(&service, &node));
  check(rcl_node_fini(&node));
  check(rclc_support_fini(&support));
  return 0;
}
