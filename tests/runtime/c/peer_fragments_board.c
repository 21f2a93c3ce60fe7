/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A board of tests/runtime/test_peer_fragments.py: publishes /OWN/text and subscribes to /OTHER/text, serves /OWN/check and
 * calls /OTHER/check; their messages are larger than the MTU of the link. Takes commands by lines, and answers each with
 * lines and `ret CODE ERROR`. A text is known by its length and SEED, 0 to 25:
 *   publish SEED SIZE    publishes a text
 *   serialized SIZE      publishes so many bytes of CDR
 *   ask SEED SIZE        calls /OTHER/check with a text
 *   spin MS              prints `got SEED SIZE`, `served SEED SIZE` and `reply SEED SIZE`; SEED is -1 if the text is wrong
 *   numbers SENT TAKEN   sets the numbers of the link's next reliable messages, while nothing is under way
 *   counts               prints `counts DROPPED MALFORMED WAITING`, the last of reliable messages of the link
 * A reply has twice the length of its request, and the next seed. */
#define _POSIX_C_SOURCE 200809L
#include <diagnostic_msgs/srv/add_diagnostics.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw/serialized_message.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/string.h>

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "microros/rmw_client.h"
#include "microros/xrce_client.h"

enum { LINE = 80, MOST = 4096, HANDLES = 3, SEEDS = 26 };

typedef diagnostic_msgs__srv__AddDiagnostics_Request request_t;
typedef diagnostic_msgs__srv__AddDiagnostics_Response response_t;

static rclc_support_t support;
static rcl_publisher_t publisher;
static rcl_client_t client;
static rcl_node_t node;
static char sent[MOST];

static rosidl_runtime_c__String text_of(unsigned seed, size_t size)
{
  const rosidl_runtime_c__String text = {sent, size, MOST};

  for (size_t i = 0; i < size; ++i) {
    sent[i] = (char)('a' + (int)((seed + i + i / 7u) % SEEDS));
  }
  sent[size] = '\0';
  return text;
}

/* Returns the seed of a text; -1: it is none. */
static int seed_of(const rosidl_runtime_c__String * text)
{
  for (size_t i = 0; i < text->size; ++i) {
    const unsigned first = (unsigned)text->data[0] - 'a';

    if (text->data[i] != (char)('a' + (int)((first + i + i / 7u) % SEEDS))) {
      return -1;
    }
  }
  return text->size != 0u ? text->data[0] - 'a' : -1;
}

static void print(const char * what, const rosidl_runtime_c__String * text)
{
  (void)printf("%s %d %u\n", what, seed_of(text), (unsigned)text->size);
}

static void hear(const void * message)
{
  print("got", &((const std_msgs__msg__String *)message)->data);
}

static void hear_reply(const void * response)
{
  print("reply", &((const response_t *)response)->message);
}

static void serve(const void * request, void * response)
{
  const rosidl_runtime_c__String * text = &((const request_t *)request)->load_namespace;

  print("served", text);
  ((response_t *)response)->message = text_of((unsigned)(seed_of(text) + 1) % SEEDS, 2u * text->size);
}

static bool open_subscription(rclc_executor_t * executor)
{
  static char bytes[MOST];
  static std_msgs__msg__String message = {{bytes, 0, MOST}};
  static rcl_subscription_t subscription;
  const rosidl_message_type_support_t * string = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);

  return rclc_subscription_init_default(&subscription, &node, string, "/" OTHER "/text") == RCL_RET_OK &&
         rclc_executor_add_subscription(executor, &subscription, &message, hear, ON_NEW_DATA) == RCL_RET_OK;
}

static bool start(rclc_executor_t * executor)
{
  static char bytes[2][MOST];
  static request_t request = {{bytes[0], 0, MOST}};
  static response_t reply = {false, {bytes[1], 0, MOST}};
  static response_t response;
  static rcl_service_t service;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  const rosidl_message_type_support_t * string = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);
  const rosidl_service_type_support_t * check =
    ROSIDL_GET_SRV_TYPE_SUPPORT(diagnostic_msgs, srv, AddDiagnostics);

  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "board", "", &support) == RCL_RET_OK &&
         rclc_executor_init(executor, &support.context, HANDLES, &allocator) == RCL_RET_OK &&
         rclc_publisher_init_default(&publisher, &node, string, "/" OWN "/text") == RCL_RET_OK &&
         rclc_service_init_default(&service, &node, check, "/" OWN "/check") == RCL_RET_OK &&
         rclc_client_init_default(&client, &node, check, "/" OTHER "/check") == RCL_RET_OK &&
         rclc_executor_add_service(executor, &service, &request, &response, serve) == RCL_RET_OK &&
         rclc_executor_add_client(executor, &client, &reply, hear_reply) == RCL_RET_OK;
}

static rcl_ret_t publish(unsigned seed, size_t size)
{
  const std_msgs__msg__String message = {text_of(seed, size)};

  return rcl_publish(&publisher, &message, NULL);
}

static rcl_ret_t publish_bytes(size_t size)
{
  static uint8_t bytes[MOST] = {0, 1};
  rcl_serialized_message_t message = rmw_get_zero_initialized_serialized_message();

  message.buffer = bytes;
  message.buffer_length = size;
  message.buffer_capacity = sizeof(bytes);
  return rcl_publish_serialized_message(&publisher, &message, NULL);
}

static rcl_ret_t ask(unsigned seed, size_t size)
{
  const request_t request = {text_of(seed, size)};
  int64_t sequence = 0;

  return rcl_send_request(&client, &request, &sequence);
}

static rcl_ret_t print_counts(void)
{
  rmw_uros_statistics_t statistics;
  const rcl_ret_t code = rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics);

  (void)printf(
    "counts %u %u %u\n", (unsigned)statistics.dropped, (unsigned)statistics.malformed,
    (unsigned)rmw_client_instance()->peers[0].count);
  return code;
}

static rcl_ret_t obey(const char * line, rclc_executor_t * executor)
{
  unsigned first;
  unsigned second;

  if (sscanf(line, "publish %u %u", &first, &second) == 2 && second < MOST) {
    return publish(first, second);
  }
  if (sscanf(line, "serialized %u", &first) == 1 && first <= MOST) {
    return publish_bytes(first);
  }
  if (sscanf(line, "ask %u %u", &first, &second) == 2 && second < MOST / 2) {
    return ask(first, second);
  }
  if (sscanf(line, "spin %u", &first) == 1) {
    const rcl_ret_t code = rclc_executor_spin_some(executor, RCL_MS_TO_NS(first));

    return code == RCL_RET_TIMEOUT ? RCL_RET_OK : code;
  }
  if (sscanf(line, "numbers %u %u", &first, &second) == 2) {
    rmw_client_instance()->peers[0].first = (uint16_t)first;
    rmw_client_instance()->peers[0].next = (uint16_t)second;
    return RCL_RET_OK;
  }
  if (strcmp(line, "open\n") == 0) {
    return open_subscription(executor) ? RCL_RET_OK : RCL_RET_ERROR;
  }
  return strcmp(line, "counts\n") == 0 ? print_counts() : RCL_RET_INVALID_ARGUMENT;
}

int main(int count, char * arguments[])
{
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  char line[LINE];

  (void)arguments; /* with any, the program opens its subscription when it is asked to */
  if (!start(&executor) || (count == 1 && !open_subscription(&executor))) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    return 2;
  }
  while (fgets(line, sizeof(line), stdin) != NULL) {
    const rcl_ret_t code = obey(line, &executor);

    (void)printf("ret %d %s\n", (int)code, code == RCL_RET_OK ? "" : rcl_get_error_string().str);
    rcl_reset_error();
    if (fflush(stdout) != 0) {
      return 3;
    }
  }
  return 0;
}
