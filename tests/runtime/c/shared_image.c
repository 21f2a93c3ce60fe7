/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An image of tests/runtime/test_shared_memory.py: publishes /OWN/best and /OWN/sure, subscribes to /OTHER/best and
 * /OTHER/sure. Takes commands by lines, and answers each with lines and `ret CODE ERROR`:
 *   publish TOPIC TEXT     TOPIC 0: best, 1: sure
 *   bytes TOPIC TEXT       the same as a serialized message
 *   spin MS                prints `got TOPIC TEXT` for each message, and `error TEXT` for what the executor reports
 *   dropped                `dropped COUNT` of messages, of all topics
 *   take TOPIC             takes one as bytes: `got TOPIC TEXT`
 *   flood MS FIRST         publishes numbers on 0, each three times in a text, as fast as it can: `sent COUNT`
 *   listen MS              hears them: `heard COUNT`, `torn COUNT` and `back COUNT` of what is not as it was sent
 *   ask A B                sends a request to /OTHER/sum: `sent NUMBER`
 *   serve                  takes a request of /OWN/sum and keeps it: `asked A B`
 *   respond                answers that
 *   reply                  takes a response: `reply NUMBER SUM`
 *   attend                 from now on `spin` answers requests and prints replies
 *   available              `available COUNT` of servers that the client has in the other image
 *   unsubscribe            closes the subscriptions
 *   close, open            shuts the context down, begins again
 * Of a chip with three images (tests/runtime/test_shared_group.py), OUT_NAMES and IN_NAMES are the topics, the first of which is best
 * effort, SERVED and ASKED the services, if it has any. */
#include <example_interfaces/srv/add_two_ints.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw/serialized_message.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/string.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "microros/port.h"
#include "microros/rmw_local_service.h"

#ifndef OUT_NAMES
#define OUT_NAMES "/" OWN "/best", "/" OWN "/sure"
#define IN_NAMES "/" OTHER "/best", "/" OTHER "/sure"
#define SERVED "/" OWN "/sum"
#define ASKED "/" OTHER "/sum"
#endif

enum { ENDS = 2, LINE = 80, TEXT = 41, NUMBER = 10, BYTES = 64 };

static const char * const out_names[] = {OUT_NAMES};
static const char * const in_names[] = {IN_NAMES};

enum { OUTS = sizeof(out_names) / sizeof(out_names[0]), INS = sizeof(in_names) / sizeof(in_names[0]) };

static rcl_publisher_t publishers[OUTS];
static rcl_subscription_t subscriptions[INS];
static rcl_service_t service;
static rcl_client_t client;
static rmw_request_id_t asked_by;
static int64_t asked_sum;
static bool listens;
static uint32_t last;
static unsigned heard_count;
static unsigned torn_count;
static unsigned back_count;

static void listen_to(const char * text)
{
  char digits[NUMBER + 1] = "";
  uint32_t number;

  (void)strncat(digits, text, NUMBER);
  number = (uint32_t)strtoul(digits, NULL, 10);
  ++heard_count;
  if (
    strlen(text) != 3u * (size_t)NUMBER || memcmp(text, &text[NUMBER], NUMBER) != 0 ||
    memcmp(text, &text[2 * NUMBER], NUMBER) != 0) {
    ++torn_count;
  }
  back_count += number <= last ? 1u : 0u;
  last = number;
}

static void hear(const void * message, void * context)
{
  const char * text = ((const std_msgs__msg__String *)message)->data.data;

  if (listens) {
    listen_to(text);
  } else {
    (void)printf("got %s %s\n", (const char *)context, text);
  }
}

static rcl_ret_t ask(int64_t a, int64_t b)
{
  const example_interfaces__srv__AddTwoInts_Request request = {.a = a, .b = b};
  int64_t number = 0;
  const rcl_ret_t code = rcl_send_request(&client, &request, &number);

  if (code == RCL_RET_OK) {
    (void)printf("sent %" PRId64 "\n", number);
  }
  return code;
}

static rcl_ret_t serve(void)
{
  example_interfaces__srv__AddTwoInts_Request request;
  const rcl_ret_t code = rcl_take_request(&service, &asked_by, &request);

  if (code == RCL_RET_OK) {
    (void)printf("asked %" PRId64 " %" PRId64 "\n", request.a, request.b);
    asked_sum = request.a + request.b;
  }
  return code;
}

static rcl_ret_t respond(void)
{
  example_interfaces__srv__AddTwoInts_Response response = {.sum = asked_sum};

  return rcl_send_response(&service, &asked_by, &response);
}

static rcl_ret_t take_reply(void)
{
  example_interfaces__srv__AddTwoInts_Response response;
  rmw_request_id_t id;
  const rcl_ret_t code = rcl_take_response(&client, &id, &response);

  if (code == RCL_RET_OK) {
    (void)printf("reply %" PRId64 " %" PRId64 "\n", id.sequence_number, response.sum);
  }
  return code;
}

#ifdef SERVED
static void on_request(const void * request, void * response)
{
  const example_interfaces__srv__AddTwoInts_Request * in = request;

  (void)printf("asked %" PRId64 " %" PRId64 "\n", in->a, in->b);
  ((example_interfaces__srv__AddTwoInts_Response *)response)->sum = in->a + in->b;
}
#endif

#ifdef ASKED
static void on_reply(const void * response, rmw_request_id_t * id)
{
  const example_interfaces__srv__AddTwoInts_Response * in = response;

  (void)printf("reply %" PRId64 " %" PRId64 "\n", id->sequence_number, in->sum);
}
#endif

static rcl_ret_t attend(rclc_executor_t * executor)
{
  rcl_ret_t code = RCL_RET_OK;
#ifdef SERVED
  static example_interfaces__srv__AddTwoInts_Request request;
  static example_interfaces__srv__AddTwoInts_Response response;

  code = rclc_executor_add_service(executor, &service, &request, &response, on_request);
#endif
#ifdef ASKED
  static example_interfaces__srv__AddTwoInts_Response reply;

  if (code == RCL_RET_OK) {
    code = rclc_executor_add_client_with_request_id(executor, &client, &reply, on_reply);
  }
#endif
  return code;
}

/* The question that rcl_service_server_is_available asks (component graph, which needs an agent). */
static void available(void)
{
  bool is_open = false;
  const bool is_known = rmw_local_server(client.impl->data, &is_open);

  (void)printf("available %d\n", is_known && is_open ? 1 : 0);
}

static rcl_ret_t unsubscribe(rcl_node_t * node)
{
  rcl_ret_t code = RCL_RET_OK;

  for (size_t i = 0; i < (size_t)INS && code == RCL_RET_OK; ++i) {
    code = rcl_subscription_fini(&subscriptions[i], node);
  }
  return code;
}

static int answer(rcl_ret_t code)
{
  (void)printf("ret %d %s\n", (int)code, code == RCL_RET_OK ? "" : rcl_get_error_string().str);
  rcl_reset_error();
  return fflush(stdout);
}

static rcl_ret_t publish(unsigned topic, char * text)
{
  const std_msgs__msg__String message = {.data = {text, strlen(text), strlen(text) + 1u}};

  return rcl_publish(&publishers[topic], &message, NULL);
}

/* The message as CDR: encapsulation, length with terminator, characters. */
static rcl_ret_t publish_bytes(unsigned topic, const char * text)
{
  static uint8_t buffer[BYTES + LINE];
  const size_t size = strlen(text) + 1u;
  rcl_serialized_message_t message = rmw_get_zero_initialized_serialized_message();

  buffer[1] = 1u;
  buffer[4] = (uint8_t)size;
  (void)memcpy(&buffer[8], text, size);
  message.buffer = buffer;
  message.buffer_length = 8u + size;
  message.buffer_capacity = sizeof(buffer);
  return rcl_publish_serialized_message(&publishers[topic], &message, NULL);
}

static rcl_ret_t take(unsigned topic)
{
  static uint8_t buffer[BYTES];
  rcl_serialized_message_t message = rmw_get_zero_initialized_serialized_message();
  rcl_ret_t code;

  message.buffer = buffer;
  message.buffer_capacity = sizeof(buffer);
  code = rcl_take_serialized_message(&subscriptions[topic], &message, NULL, NULL);
  if (code == RCL_RET_OK) {
    (void)printf("got %u %s\n", topic, (const char *)&buffer[8]);
  }
  return code;
}

static void spin(rclc_executor_t * executor, uint32_t duration_ms)
{
  const uint32_t start = port_time_ms();

  do {
    if (rclc_executor_spin_some(executor, RCL_MS_TO_NS(1)) == RCL_RET_ERROR) {
      (void)printf("error %s\n", rcl_get_error_string().str);
      rcl_reset_error();
    }
  } while (port_time_ms() - start < duration_ms);
}

static rcl_ret_t dropped(const rclc_support_t * support)
{
  rmw_uros_statistics_t statistics;
  const rmw_ret_t result =
    rmw_uros_get_statistics(rcl_context_get_rmw_context((rcl_context_t *)&support->context), &statistics);

  (void)printf("dropped %" PRIu32 "\n", statistics.dropped);
  return result == RMW_RET_OK ? RCL_RET_OK : RCL_RET_ERROR;
}

static void flood(uint32_t duration_ms, uint32_t first)
{
  const uint32_t start = port_time_ms();
  uint32_t number = first;
  unsigned sent = 0;

  do {
    char text[TEXT];

    (void)snprintf(text, sizeof(text), "%010" PRIu32 "%010" PRIu32 "%010" PRIu32, number, number, number);
    ++number;
    sent += publish(0, text) == RCL_RET_OK ? 1u : 0u;
  } while (port_time_ms() - start < duration_ms);
  (void)printf("sent %u\n", sent);
}

static void listen(rclc_executor_t * executor, uint32_t duration_ms)
{
  const uint32_t start = port_time_ms();

  listens = true;
  do {
    (void)rclc_executor_spin_some(executor, 0);
  } while (port_time_ms() - start < duration_ms);
  listens = false;
  (void)printf("heard %u\ntorn %u\nback %u\n", heard_count, torn_count, back_count);
}

static bool open_topics(rcl_node_t * node, rclc_executor_t * executor)
{
  static char topics[INS][2];
  static std_msgs__msg__String heard[INS];
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);
  bool is_open = true;

  for (size_t i = 0; i < (size_t)OUTS; ++i) {
    is_open = is_open &&
              (i == 0 ? rclc_publisher_init_best_effort(&publishers[i], node, type, out_names[i])
                      : rclc_publisher_init_default(&publishers[i], node, type, out_names[i])) == RCL_RET_OK;
  }
  for (size_t i = 0; i < (size_t)INS; ++i) {
    topics[i][0] = (char)('0' + (int)i);
    is_open =
      is_open &&
      (i == 0 ? rclc_subscription_init_best_effort(&subscriptions[i], node, type, in_names[i])
              : rclc_subscription_init_default(&subscriptions[i], node, type, in_names[i])) == RCL_RET_OK &&
      rclc_executor_add_subscription_with_context(
        executor, &subscriptions[i], &heard[i], hear, topics[i], ON_NEW_DATA) == RCL_RET_OK;
  }
  return is_open;
}

static bool open_services(rcl_node_t * node)
{
  const rosidl_service_type_support_t * sum =
    ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts);
  bool is_open = true;

#ifdef SERVED
  is_open = rclc_service_init_default(&service, node, sum, SERVED) == RCL_RET_OK;
#endif
#ifdef ASKED
  is_open = is_open && rclc_client_init_default(&client, node, sum, ASKED) == RCL_RET_OK;
#endif
  return is_open;
}

static int open_all(rclc_support_t * support, rcl_node_t * node, rclc_executor_t * executor)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(node, OWN, "", support) != RCL_RET_OK ||
    rclc_executor_init(executor, &support->context, INS + ENDS, &allocator) != RCL_RET_OK) {
    return 2;
  }
  if (!open_topics(node, executor)) {
    return 3;
  }
  return open_services(node) ? 0 : 3;
}

/* Ends the context first, as an application may do that stops in a hurry. */
static rcl_ret_t close_all(rclc_support_t * support, rcl_node_t * node, rclc_executor_t * executor)
{
  const rcl_ret_t code = rcl_shutdown(&support->context);

  for (size_t i = 0; i < (size_t)OUTS; ++i) {
    (void)rcl_publisher_fini(&publishers[i], node);
  }
  for (size_t i = 0; i < (size_t)INS; ++i) {
    (void)rcl_subscription_fini(&subscriptions[i], node);
  }
  (void)rcl_service_fini(&service, node);
  (void)rcl_client_fini(&client, node);
  (void)rclc_executor_fini(executor);
  (void)rcl_node_fini(node);
  (void)rclc_support_fini(support);
  rcl_reset_error();
  *node = rcl_get_zero_initialized_node();
  *executor = rclc_executor_get_zero_initialized_executor();
  return code;
}

int main(void)
{
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  char line[LINE];
  char text[LINE];
  unsigned topic;
  int value = open_all(&support, &node, &executor);

  if (value != 0) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    return value;
  }
  while (fgets(line, sizeof(line), stdin) != NULL) {
    rcl_ret_t code = RCL_RET_OK;

    if (sscanf(line, "publish %u %79s", &topic, text) == 2 && topic < OUTS) {
      code = publish(topic, text);
    } else if (sscanf(line, "bytes %u %79s", &topic, text) == 2 && topic < OUTS) {
      code = publish_bytes(topic, text);
    } else if (sscanf(line, "take %u", &topic) == 1 && topic < INS) {
      code = take(topic);
    } else if (sscanf(line, "spin %d", &value) == 1) {
      spin(&executor, (uint32_t)value);
    } else if (strcmp(line, "dropped\n") == 0) {
      code = dropped(&support);
    } else if (sscanf(line, "flood %d %u", &value, &topic) == 2) {
      flood((uint32_t)value, topic);
    } else if (sscanf(line, "listen %d", &value) == 1) {
      listen(&executor, (uint32_t)value);
    } else if (sscanf(line, "ask %d %u", &value, &topic) == 2) {
      code = ask(value, topic);
    } else if (strcmp(line, "serve\n") == 0) {
      code = serve();
    } else if (strcmp(line, "respond\n") == 0) {
      code = respond();
    } else if (strcmp(line, "reply\n") == 0) {
      code = take_reply();
    } else if (strcmp(line, "attend\n") == 0) {
      code = attend(&executor);
    } else if (strcmp(line, "available\n") == 0) {
      available();
    } else if (strcmp(line, "unsubscribe\n") == 0) {
      code = unsubscribe(&node);
    } else if (strcmp(line, "close\n") == 0) {
      code = close_all(&support, &node, &executor);
    } else if (strcmp(line, "open\n") == 0) {
      code = open_all(&support, &node, &executor) == 0 ? RCL_RET_OK : RCL_RET_ERROR;
    } else {
      return 4;
    }
    if (answer(code) != 0) {
      return 5;
    }
  }
  return 0;
}
