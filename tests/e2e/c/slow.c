/* SPDX-License-Identifier: Apache-2.0 */
/*
 * All that goes through a session, for a link that is slow: gives samples back, adds numbers, has numbers added, asks the time,
 * pings, and says what each took. Arguments: how many samples and requests to wait for, how long, in seconds, and `poll`: without
 * the executor, by asking each entity in turn.
 */
#include <example_interfaces/srv/add_two_ints.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { LONG_MS = 60000, QUESTIONS = 2, POLL_NS = 10000000 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t subscription;
static rcl_publisher_t publisher;
static rcl_service_t service;
static rcl_client_t client;
static rclc_executor_t executor;
static std_msgs__msg__Int32 number;
static example_interfaces__srv__AddTwoInts_Request request;
static example_interfaces__srv__AddTwoInts_Response response;
static example_interfaces__srv__AddTwoInts_Response reply;
static long left;

static long now_ms(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (long)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void on_number(const void * message)
{
  const std_msgs__msg__Int32 * taken = message;

  check(rcl_publish(&publisher, taken, NULL), "publish");
  --left;
}

static void add(const void * request_msg, void * response_msg)
{
  const example_interfaces__srv__AddTwoInts_Request * numbers = request_msg;
  example_interfaces__srv__AddTwoInts_Response * sum = response_msg;

  sum->sum = numbers->a + numbers->b;
  --left;
}

static void on_reply(const void * response_msg)
{
  const example_interfaces__srv__AddTwoInts_Response * sum = response_msg;

  (void)printf("sum %" PRId64 "\n", sum->sum);
  --left;
}

/* Has 10 + 1, 20 + 2 and so on added elsewhere. */
static void ask(void)
{
  for (int64_t i = 1; i <= QUESTIONS; ++i) {
    const example_interfaces__srv__AddTwoInts_Request question = {10 * i, i};
    int64_t sequence = 0;

    check(rcl_send_request(&client, &question, &sequence), "request");
    ++left;
  }
}

/* Returns whether there was something to take. */
static bool took(rcl_ret_t result, rcl_ret_t none, const char * what)
{
  if (result != none) {
    check(result, what);
  }
  return result == RCL_RET_OK;
}

static void poll(void)
{
  const struct timespec pause = {0, POLL_NS};
  rmw_request_id_t header;

  if (took(rcl_take(&subscription, &number, NULL, NULL), RCL_RET_SUBSCRIPTION_TAKE_FAILED, "take")) {
    on_number(&number);
  }
  if (took(rcl_take_request(&service, &header, &request), RCL_RET_SERVICE_TAKE_FAILED, "take request")) {
    add(&request, &response);
    check(rcl_send_response(&service, &header, &response), "response");
  }
  if (took(rcl_take_response(&client, &header, &reply), RCL_RET_CLIENT_TAKE_FAILED, "take response")) {
    on_reply(&reply);
  }
  (void)nanosleep(&pause, NULL);
}

static void begin(rcl_allocator_t * allocator)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);

  check(rclc_support_init(&support, 0, NULL, allocator), "init");
  check(rclc_node_init_default(&node, "slow", "", &support), "node");
  check(rclc_publisher_init_default(&publisher, &node, type, "slow_out"), "publisher");
  check(rclc_subscription_init_default(&subscription, &node, type, "slow_in"), "subscription");
  check(
    rclc_service_init_default(
      &service, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts), "slow_sum"),
    "service");
  check(
    rclc_client_init_default(
      &client, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts), "slow_far"),
    "client");
  check(rclc_executor_init(&executor, &support.context, 3, allocator), "executor");
  check(rclc_executor_add_subscription(&executor, &subscription, &number, on_number, ON_NEW_DATA), "add");
  check(rclc_executor_add_service(&executor, &service, &request, &response, add), "add service");
  check(rclc_executor_add_client(&executor, &client, &reply, on_reply), "add client");
}

int main(int argc, char ** argv)
{
  const long start = now_ms();
  const long end = start + 1000 * (argc > 2 ? strtol(argv[2], NULL, 10) : 60);
  const bool polls = argc > 3 && strcmp(argv[3], "poll") == 0;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rmw_uros_statistics_t counted;

  left = argc > 1 ? strtol(argv[1], NULL, 10) : 0;
  begin(&allocator);
  (void)printf("created after %ld ms\n", now_ms() - start);
  check(rmw_uros_sync_session(LONG_MS), "time");
  (void)printf("time %" PRId64 "\n", rmw_uros_epoch_millis());
  check(rmw_uros_ping_agent(LONG_MS, 1), "ping");
  (void)printf("ready after %ld ms\n", now_ms() - start);
  (void)fflush(stdout);
  ask();
  while (left > 0 && now_ms() < end) {
    if (polls) {
      poll();
    } else {
      (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100));
    }
  }
  check(rcl_publisher_wait_for_all_acked(&publisher, RCL_S_TO_NS(60)), "flush");
  check(rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &counted), "statistics");
  (void)printf(
    "left=%ld sent=%" PRIu32 " resent=%" PRIu32 " malformed=%" PRIu32 " dropped=%" PRIu32
    " reconnects=%" PRIu32 "\n",
    left, counted.sent, counted.resent, counted.malformed, counted.dropped, counted.reconnects);
  return 0;
}
