/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A board of tests/runtime/test_peer_services.py and tests/e2e/test_peer_services.py: serves /OWN/add in its executor, and /OWN/later when told to; calls both
 * of the other board. Publishes /OWN/sure and /OWN/best, and subscribes to those of the other board. Takes commands by lines, and answers each with
 * lines and `ret CODE ERROR`:
 *   spin MS              prints `served A B`, `reply SEQUENCE SUM` and `got VALUE`
 *   ask A B              calls /OTHER/add, prints `asked SEQUENCE`
 *   ask_later A B        the same with /OTHER/later; its reply is printed as `later SEQUENCE SUM`
 *   take                 takes a request of /OWN/later if there is one, prints `taken A B`
 *   answer I             answers the i-th one that was taken
 *   signal VALUE         publishes it on /OWN/best
 *   greedy 1             callbacks of /OWN/add publish until they may not any more, and print `published COUNT ERROR`
 *   hasty 1              callbacks of /OWN/add finalize their service and open it again
 *   close, open          finalize /OWN/add, and open it again
 *   numbers SENT TAKEN   sets the numbers of the link's next reliable messages, while nothing is under way, and that of the
 *                        next request
 *   counts               prints `counts DROPPED INTERRUPTED WAITING`, the last of reliable messages of the link
 *   open_sure            (with LATE) subscribes to /OTHER/sure, which is printed as `got VALUE`
 *   close_client         finalizes the client of /OTHER/later
 *   available            (with HAS_GRAPH) prints `available 1` if the server of /OTHER/add is, else `available 0`
 * The first argument is what port_time_ms starts with. */
#define _POSIX_C_SOURCE 200809L
#include <example_interfaces/srv/add_two_ints.h>
#include <rcl/error_handling.h>
#ifdef HAS_GRAPH
#include <rcl/graph.h>
#endif
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/xrce_client.h"

enum { LINE = 80, HELD = 8, HANDLES = 5 };

#ifndef LATE
#define LATE false
#endif

typedef example_interfaces__srv__AddTwoInts_Request request_t;
typedef example_interfaces__srv__AddTwoInts_Response response_t;

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_publisher_t best;
static rcl_service_t add;
static rcl_service_t later;
static rcl_client_t add_client;
static rcl_client_t later_client;
static rcl_subscription_t sure;
static rmw_request_id_t held[HELD];
static int64_t sums[HELD];
static size_t held_count;
static bool greedy;
static bool hasty;
static uint32_t offset_ms;

/* Instead of port_posix_time.c. */
uint32_t port_time_ms(void)
{
  struct timespec now = {0, 0};

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return offset_ms + (uint32_t)((uint64_t)now.tv_sec * 1000u + (uint64_t)now.tv_nsec / 1000000u);
}

int64_t port_time_epoch_ns(void)
{
  return 0;
}

void port_sleep_ms(uint32_t duration_ms)
{
  const struct timespec left = {0, (long)duration_ms * 1000000L};

  (void)nanosleep(&left, NULL);
}

static const rosidl_service_type_support_t * type(void)
{
  return ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts);
}

static void publish_all(void)
{
  std_msgs__msg__Int32 message = {0};

  while (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
    ++message.data;
  }
  (void)printf("published %d %s\n", (int)message.data, rcl_get_error_string().str);
  rcl_reset_error();
}

static void serve(const void * request, void * response, void * context)
{
  const request_t * asked = request;

  (void)printf("%s %d %d\n", (const char *)context, (int)asked->a, (int)asked->b);
  ((response_t *)response)->sum = asked->a + asked->b;
  if (greedy) {
    publish_all();
  }
  if (hasty) {
    (void)rcl_service_fini(&add, &node);
  }
}

static void hear_reply(const void * response, rmw_request_id_t * request)
{
  (void)printf("reply %d %d\n", (int)request->sequence_number, (int)((const response_t *)response)->sum);
}

static void hear_later(const void * response, rmw_request_id_t * request)
{
  (void)printf("later %d %d\n", (int)request->sequence_number, (int)((const response_t *)response)->sum);
}

static void hear(const void * message)
{
  (void)printf("got %d\n", (int)((const std_msgs__msg__Int32 *)message)->data);
}

static int answer(rcl_ret_t code)
{
  (void)printf("ret %d %s\n", (int)code, code == RCL_RET_OK ? "" : rcl_get_error_string().str);
  rcl_reset_error();
  return fflush(stdout);
}

/* Returns the first error of the executor. */
static rcl_ret_t spin(rclc_executor_t * executor, uint32_t duration_ms)
{
  const uint32_t start = port_time_ms();
  rcl_ret_t result = RCL_RET_OK;

  do {
    const rcl_ret_t code = rclc_executor_spin_some(executor, RCL_MS_TO_NS(1));

    result = code != RCL_RET_OK && code != RCL_RET_TIMEOUT ? code : result;
  } while (result == RCL_RET_OK && port_time_ms() - start < duration_ms);
  return result;
}

static rcl_ret_t ask(const rcl_client_t * client, int a, int b)
{
  const request_t request = {.a = a, .b = b};
  int64_t sequence = 0;
  const rcl_ret_t code = rcl_send_request(client, &request, &sequence);

  if (code == RCL_RET_OK) {
    (void)printf("asked %d\n", (int)sequence);
  }
  return code;
}

static rcl_ret_t take(void)
{
  request_t request;
  const rcl_ret_t code = rcl_take_request(&later, &held[held_count % HELD], &request);

  if (code == RCL_RET_OK) {
    (void)printf("taken %d %d\n", (int)request.a, (int)request.b);
    sums[held_count % HELD] = request.a + request.b;
    ++held_count;
  }
  return code == RCL_RET_SERVICE_TAKE_FAILED ? RCL_RET_OK : code;
}

static rcl_ret_t answer_later(unsigned i)
{
  response_t response = {.sum = sums[i]};

  return rcl_send_response(&later, &held[i], &response);
}

/* Only while nothing is under way. */
static void set_numbers(unsigned sent, unsigned taken)
{
  xrce_client_t * client = rmw_client_instance();

  client->peers[0].first = (uint16_t)sent;
  client->peers[0].next = (uint16_t)taken;
  client->session.request = (uint16_t)sent;
}

#ifdef HAS_GRAPH
static rcl_ret_t print_available(void)
{
  bool is_available = false;
  const rcl_ret_t code = rcl_service_server_is_available(&node, &add_client, &is_available);

  (void)printf("available %d\n", is_available ? 1 : 0);
  return code;
}
#endif

static bool subscribe(rclc_executor_t * executor)
{
  static std_msgs__msg__Int32 heard;
  const rosidl_message_type_support_t * int32 = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);

  return rclc_subscription_init_default(&sure, &node, int32, "/" OTHER "/sure") == RCL_RET_OK &&
         rclc_executor_add_subscription(executor, &sure, &heard, hear, ON_NEW_DATA) == RCL_RET_OK;
}

static rcl_ret_t close_client(rclc_executor_t * executor)
{
  const rcl_ret_t code = rclc_executor_remove_client(executor, &later_client);

  return code != RCL_RET_OK ? code : rcl_client_fini(&later_client, &node);
}

static bool start(rclc_executor_t * executor)
{
  static request_t request;
  static response_t response;
  static response_t reply;
  static response_t later_reply;
  static std_msgs__msg__Int32 best_heard;
  static char context[] = "served";
  rcl_allocator_t allocator = rcl_get_default_allocator();
  static rcl_subscription_t best_subscription;
  const rosidl_message_type_support_t * int32 = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);

  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "board", "", &support) == RCL_RET_OK &&
         rclc_executor_init(executor, &support.context, HANDLES, &allocator) == RCL_RET_OK &&
         rclc_publisher_init_default(&publisher, &node, int32, "/" OWN "/sure") == RCL_RET_OK &&
         rclc_publisher_init_best_effort(&best, &node, int32, "/" OWN "/best") == RCL_RET_OK &&
         rclc_subscription_init_best_effort(&best_subscription, &node, int32, "/" OTHER "/best") ==
           RCL_RET_OK &&
         rclc_executor_add_subscription(executor, &best_subscription, &best_heard, hear, ON_NEW_DATA) ==
           RCL_RET_OK &&
         rclc_service_init_default(&add, &node, type(), "/" OWN "/add") == RCL_RET_OK &&
         rclc_service_init_default(&later, &node, type(), "/" OWN "/later") == RCL_RET_OK &&
         rclc_client_init_default(&add_client, &node, type(), "/" OTHER "/add") == RCL_RET_OK &&
         rclc_client_init_default(&later_client, &node, type(), "/" OTHER "/later") == RCL_RET_OK &&
         (LATE || subscribe(executor)) &&
         rclc_executor_add_service_with_context(executor, &add, &request, &response, serve, context) ==
           RCL_RET_OK &&
         rclc_executor_add_client_with_request_id(executor, &add_client, &reply, hear_reply) == RCL_RET_OK &&
         rclc_executor_add_client_with_request_id(executor, &later_client, &later_reply, hear_later) ==
           RCL_RET_OK;
}

static rcl_ret_t reopen(void)
{
  return rclc_service_init_default(&add, &node, type(), "/" OWN "/add");
}

static rcl_ret_t print_counts(void)
{
  rmw_uros_statistics_t statistics;
  const rcl_ret_t code = rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics);

  (void)printf(
    "counts %u %u %u\n", (unsigned)statistics.dropped,
    (unsigned)rmw_client_instance()->requesters[1].interrupted,
    (unsigned)rmw_client_instance()->peers[0].count);
  return code;
}

int main(int argc, char ** argv)
{
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  char line[LINE];
  unsigned first;
  unsigned second;
  int a;
  int b;

  if (argc > 1) {
    offset_ms = (uint32_t)strtoul(argv[1], NULL, 0) - port_time_ms();
  }
  if (!start(&executor)) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    return 2;
  }
  while (fgets(line, sizeof(line), stdin) != NULL) {
    rcl_ret_t code = RCL_RET_OK;

    if (sscanf(line, "spin %d", &a) == 1) {
      code = spin(&executor, (uint32_t)a);
    } else if (sscanf(line, "ask %d %d", &a, &b) == 2) {
      code = ask(&add_client, a, b);
    } else if (sscanf(line, "ask_later %d %d", &a, &b) == 2) {
      code = ask(&later_client, a, b);
    } else if (strcmp(line, "take\n") == 0) {
      code = take();
    } else if (sscanf(line, "answer %u", &first) == 1 && first < HELD) {
      code = answer_later(first);
    } else if (sscanf(line, "signal %d", &a) == 1) {
      const std_msgs__msg__Int32 message = {.data = a};

      code = rcl_publish(&best, &message, NULL);
    } else if (sscanf(line, "greedy %d", &a) == 1) {
      greedy = a != 0;
    } else if (sscanf(line, "hasty %d", &a) == 1) {
      hasty = a != 0;
    } else if (strcmp(line, "open\n") == 0) {
      code = reopen();
    } else if (LATE && strcmp(line, "open_sure\n") == 0) {
      code = subscribe(&executor) ? RCL_RET_OK : RCL_RET_ERROR;
    } else if (strcmp(line, "close_client\n") == 0) {
      code = close_client(&executor);
    } else if (strcmp(line, "close\n") == 0) {
      code = rcl_service_fini(&add, &node);
    } else if (sscanf(line, "numbers %u %u", &first, &second) == 2) {
      set_numbers(first, second);
    } else if (strcmp(line, "counts\n") == 0) {
      code = print_counts();
#ifdef HAS_GRAPH
    } else if (strcmp(line, "available\n") == 0) {
      code = print_available();
#endif
    } else {
      return 4;
    }
    if (answer(code) != 0) {
      return 5;
    }
  }
  return 0;
}
