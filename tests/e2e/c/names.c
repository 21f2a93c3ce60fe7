/* SPDX-License-Identifier: Apache-2.0 */
/* Strings in requests and responses, filled as sources for micro-ROS fill them: asks rclpy once, then answers it once. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rcl_interfaces/srv/list_parameters.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rosidl_runtime_c/string_functions.h>

#include <stdio.h>

#define CHECK(condition) \
  do { \
    if (!(condition)) { \
      (void)fprintf(stderr, "line %d: %s\n", __LINE__, rcl_get_error_string().str); \
      return 1; \
    } \
  } while (0)

typedef rcl_interfaces__srv__ListParameters_Request request_t;
typedef rcl_interfaces__srv__ListParameters_Response response_t;

static rclc_support_t support;
static rcl_node_t node;
static rcl_service_t service;
static rcl_client_t client;
static rclc_executor_t executor;
static bool replied, answered;

static void print_names(const rosidl_runtime_c__String__Sequence * names)
{
  for (size_t i = 0; i < names->size; ++i) {
    (void)printf(" %s", names->data[i].data);
  }
  (void)printf("\n");
  (void)fflush(stdout);
}

static void on_reply(const void * message)
{
  const response_t * response = message;

  (void)printf("reply:");
  print_names(&response->result.names);
  replied = true;
}

/* Gives the names back, the last one first; another text in `prefixes`. */
static void on_request(const void * asked, void * answer)
{
  const request_t * request = asked;
  response_t * response = answer;
  const size_t count = request->prefixes.size;

  answered = rosidl_runtime_c__String__Sequence__init(&response->result.names, count) &&
             rosidl_runtime_c__String__Sequence__init(&response->result.prefixes, 1) &&
             rosidl_runtime_c__String__assign(&response->result.prefixes.data[0], "of the device");
  for (size_t i = 0; i < count && answered; ++i) {
    answered = rosidl_runtime_c__String__assign(
      &response->result.names.data[i], request->prefixes.data[count - 1u - i].data);
  }
}

static int ask(void)
{
  static request_t request;
  int64_t sequence = 0;

  CHECK(rcl_interfaces__srv__ListParameters_Request__init(&request));
  CHECK(rosidl_runtime_c__String__Sequence__init(&request.prefixes, 3));
  CHECK(rosidl_runtime_c__String__assign(&request.prefixes.data[0], "one"));
  CHECK(rosidl_runtime_c__String__assign(&request.prefixes.data[2], "a name of 17 byte"));
  CHECK(rcl_send_request(&client, &request, &sequence) == RCL_RET_OK);
  return 0;
}

int main(void)
{
  static request_t request;
  static response_t response, reply;
  const rosidl_service_type_support_t * type =
    ROSIDL_GET_SRV_TYPE_SUPPORT(rcl_interfaces, srv, ListParameters);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "names", "", &support) == RCL_RET_OK);
  CHECK(rclc_service_init_default(&service, &node, type, "names") == RCL_RET_OK);
  CHECK(rclc_client_init_default(&client, &node, type, "/peer/names") == RCL_RET_OK);
  CHECK(rcl_interfaces__srv__ListParameters_Request__init(&request));
  CHECK(rcl_interfaces__srv__ListParameters_Response__init(&response));
  CHECK(rcl_interfaces__srv__ListParameters_Response__init(&reply));
  CHECK(rclc_executor_init(&executor, &support.context, 2, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_add_service(&executor, &service, &request, &response, on_request) == RCL_RET_OK);
  CHECK(rclc_executor_add_client(&executor, &client, &reply, on_reply) == RCL_RET_OK);
  CHECK(ask() == 0);
  while (!replied || !answered) {
    CHECK(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)) == RCL_RET_OK);
  }
  for (int i = 0; i < 20; ++i) { /* the last reply has to be acknowledged */
    CHECK(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10)) == RCL_RET_OK);
  }
  CHECK(rclc_support_fini(&support) == RCL_RET_OK);
  return 0;
}
