/* SPDX-License-Identifier: Apache-2.0 */
/* A client with several requests under way: asks for the lengths of one, two, three names and so on, and prints what comes. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rcl_interfaces/srv/get_parameter_types.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rosidl_runtime_c/string.h>

#include <stdio.h>
#include <stdlib.h>

enum { MOST = 4 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_client_t client;
static rclc_executor_t executor;
static size_t answered;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void take(const void * response_msg, rmw_request_id_t * request_id)
{
  const rcl_interfaces__srv__GetParameterTypes_Response * response = response_msg;

  (void)printf("reply %ld:", (long)request_id->sequence_number);
  for (size_t i = 0; i < response->types.size; ++i) {
    (void)printf(" %u", (unsigned)response->types.data[i]);
  }
  (void)printf("\n");
  (void)fflush(stdout);
  ++answered;
}

static void ask(size_t names)
{
  static char text[] = "lengths";
  rosidl_runtime_c__String name[MOST];
  rcl_interfaces__srv__GetParameterTypes_Request request;
  int64_t sequence = 0;

  for (size_t i = 0; i < names; ++i) {
    name[i].data = text;
    name[i].size = i + 1u;
    name[i].capacity = sizeof(text);
  }
  request.names.data = name;
  request.names.size = names;
  request.names.capacity = MOST;
  check(rcl_send_request(&client, &request, &sequence), "request");
  (void)printf("request %ld\n", (long)sequence);
}

/* Arguments: how many requests. Each waits for a line of standard input. */
int main(int argc, char ** argv)
{
  const size_t count = argc > 1 ? strtoul(argv[1], NULL, 10) : 1u;
  static rcl_interfaces__srv__GetParameterTypes_Response response;
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "asker", "", &support), "node");
  check(
    rclc_client_init_default(
      &client, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(rcl_interfaces, srv, GetParameterTypes), "/peer/lengths"),
    "client");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  check(rclc_executor_add_client_with_request_id(&executor, &client, &response, take), "add");
  (void)printf("ready\n");
  (void)fflush(stdout);
  (void)getchar(); /* the server is there */
  for (size_t i = 1; i <= count; ++i) {
    ask(i);
  }
  while (answered < count) {
    check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }
  check(rclc_executor_fini(&executor), "executor fini");
  check(rcl_client_fini(&client, &node), "client fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
