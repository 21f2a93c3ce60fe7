/* SPDX-License-Identifier: Apache-2.0 */
/* A service under an executor: says how long each name is, until it has answered as often as it was told to. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rcl_interfaces/srv/get_parameter_types.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <stdio.h>
#include <stdlib.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_service_t service;
static rclc_executor_t executor;
static long left;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void answer(const void * request_msg, void * response_msg)
{
  const rcl_interfaces__srv__GetParameterTypes_Request * request = request_msg;
  rcl_interfaces__srv__GetParameterTypes_Response * response = response_msg;

  response->types.size = request->names.size;
  for (size_t i = 0; i < request->names.size; ++i) {
    response->types.data[i] = (uint8_t)request->names.data[i].size;
  }
  --left;
}

/* Arguments: how many requests to answer. */
int main(int argc, char ** argv)
{
  static rcl_interfaces__srv__GetParameterTypes_Request
    request; /* without buffers: bound to the storage of */
  static rcl_interfaces__srv__GetParameterTypes_Response response; /* the service's declaration */
  rcl_allocator_t allocator = rcl_get_default_allocator();

  left = argc > 1 ? strtol(argv[1], NULL, 10) : 1;
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "server", "/arm", &support), "node");
  check(
    rclc_service_init_default(
      &service, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(rcl_interfaces, srv, GetParameterTypes), "lengths"),
    "service");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  check(rclc_executor_add_service(&executor, &service, &request, &response, answer), "add");
  (void)printf("ready %s\n", rcl_service_get_service_name(&service));
  (void)fflush(stdout);
  while (left > 0) {
    if (rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)) != RCL_RET_OK) {
      (void)printf("refused %s\n", rcl_get_error_string().str);
      (void)fflush(stdout);
      rcl_reset_error();
    }
  }
  for (int i = 0; i < 20; ++i) { /* the last reply has to be acknowledged */
    check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10)), "spin");
  }
  check(rclc_executor_fini(&executor), "executor fini");
  check(rcl_service_fini(&service, &node), "service fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
