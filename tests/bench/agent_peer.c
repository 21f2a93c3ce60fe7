/* SPDX-License-Identifier: Apache-2.0 */
/* The ROS 2 side of the agent's bench: rcl and rmw_fastrtps_cpp from C, raw samples, KEEP_ALL.
 *
 * agent_peer count TOPIC COUNT RELIABLE PROGRESS          takes until COUNT came or nothing comes any more
 * agent_peer send TOPIC COUNT RELIABLE SIZE RATE          sends: for each byte on stdin PROGRESS_STEP samples
 * It prints `ready` when it has found its counterpart, and in the end one line of JSON. It looks once a millisecond, so that
 * taking costs the machine little: one call a sample.
 */
#define _GNU_SOURCE
#include "agent_load.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <std_msgs/msg/string.h>

#include <stdbool.h>

enum { MILLISECOND = 1000000, SILENCE = 3000, PATIENCE = 20000 };

typedef struct {
  rcl_context_t context;
  rcl_node_t node;
  rcl_subscription_t subscription;
  rcl_publisher_t publisher;
  rcl_serialized_message_t message;
} peer_t;

static peer_t peer;

static int64_t now_ns(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void check(rcl_ret_t result)
{
  if (result != RCL_RET_OK) {
    fprintf(stderr, "agent_peer: %s\n", rcl_get_error_string().str);
    exit(1);
  }
}

static void open_node(void)
{
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  rcl_node_options_t node_options = rcl_node_get_default_options();
  char name[32];

  peer.context = rcl_get_zero_initialized_context();
  peer.node = rcl_get_zero_initialized_node();
  check(rcl_init_options_init(&options, rcl_get_default_allocator()));
  check(rcl_init(0, NULL, &options, &peer.context));
  (void)snprintf(name, sizeof name, "bench_peer_%d", (int)getpid());
  node_options.enable_rosout = false;
  check(rcl_node_init(&peer.node, name, "", &peer.context, &node_options));
  check(rcl_init_options_fini(&options));
}

static rmw_qos_profile_t keep_all(bool reliable)
{
  rmw_qos_profile_t qos = rmw_qos_profile_default;

  qos.history = RMW_QOS_POLICY_HISTORY_KEEP_ALL;
  qos.reliability = reliable ? RMW_QOS_POLICY_RELIABILITY_RELIABLE : RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
  return qos;
}

static void say_ready(size_t counterparts, int64_t since)
{
  if (counterparts == 0U && now_ns() - since > (int64_t)PATIENCE * MILLISECOND) {
    fprintf(stderr, "agent_peer: nobody is there\n");
    exit(1);
  }
  if (counterparts > 0U) {
    (void)puts("ready");
    (void)fflush(stdout);
  }
}

static void wait_for_publisher(void)
{
  size_t found = 0;

  for (int64_t since = now_ns(); found == 0U;) {
    check(rcl_subscription_get_publisher_count(&peer.subscription, &found));
    agent_load_wait_until(now_ns() + MILLISECOND);
    say_ready(found, since);
  }
}

static void wait_for_subscription(void)
{
  size_t found = 0;

  for (int64_t since = now_ns(); found == 0U;) {
    check(rcl_publisher_get_subscription_count(&peer.publisher, &found));
    agent_load_wait_until(now_ns() + MILLISECOND);
    say_ready(found, since);
  }
}

/* Take one sample; return whether there was one, with its number. */
static bool take(uint32_t * number)
{
  rcl_ret_t result = rcl_take_serialized_message(&peer.subscription, &peer.message, NULL, NULL);

  if (result == RCL_RET_SUBSCRIPTION_TAKE_FAILED) {
    return false;
  }
  check(result);
  if (peer.message.buffer_length < 4U + AGENT_LOAD_SAMPLE_MINIMUM) {
    fprintf(stderr, "agent_peer: a sample of %zu bytes\n", peer.message.buffer_length);
    exit(1);
  }
  *number = agent_load_number(&peer.message.buffer[4]);
  return true;
}

static void count_samples(uint32_t count, int progress)
{
  uint32_t received = 0;
  uint32_t number = 0;
  uint32_t next = 0;
  int64_t first_at = 0;
  int64_t last_at = now_ns() + (int64_t)PATIENCE * MILLISECOND;

  if (progress >= 0) {
    agent_load_credit(progress, AGENT_LOAD_CREDITS);
  }
  while (next < count && now_ns() < last_at + (int64_t)SILENCE * MILLISECOND) {
    while (take(&number)) {
      last_at = now_ns();
      if (number < next) {
        fprintf(stderr, "agent_peer: sample %u after %u\n", number, next);
        exit(1);
      }
      if (received == 0U) {
        first_at = last_at;
      }
      next = number + 1U;
      ++received;
      if (progress >= 0 && received % AGENT_LOAD_PROGRESS_STEP == 0U) {
        agent_load_credit(progress, 1);
      }
    }
    agent_load_wait_until(now_ns() + MILLISECOND);
  }
  printf(
    "{\"samples\": %u, \"lost\": %u, \"seconds\": %.6f}\n", received, count - received,
    (double)(last_at - first_at) / 1e9);
}

static void await_credit(void)
{
  uint8_t credit = 0;

  if (read(STDIN_FILENO, &credit, 1) != 1) {
    fprintf(stderr, "agent_peer: whoever receives is gone\n");
    exit(1);
  }
}

static void send_samples(uint32_t count, size_t size, uint32_t rate)
{
  static const uint8_t encapsulation[4] = {0, 1, 0, 0};
  int64_t start = 0;

  check(rcutils_uint8_array_resize(&peer.message, size + sizeof encapsulation));
  memcpy(peer.message.buffer, encapsulation, sizeof encapsulation);
  peer.message.buffer_length = size + sizeof encapsulation;
  for (uint32_t i = 0; i < count; ++i) {
    if (i % AGENT_LOAD_PROGRESS_STEP == 0U && (rate == 0U || i == 0U)) {
      await_credit();
    }
    if (i == 0U) {
      start = now_ns();
    }
    agent_load_fill(&peer.message.buffer[4], size, i);
    check(rcl_publish_serialized_message(&peer.publisher, &peer.message, NULL));
    if (rate > 0U) {
      agent_load_wait_until(start + ((int64_t)i + 1) * 1000000000 / rate);
    }
  }
  printf("{\"samples\": %u, \"seconds\": %.6f}\n", count, (double)(now_ns() - start) / 1e9);
  (void)fflush(stdout);
  /* What was sent last may still be on its way: end when the other side has closed its end. */
  while (rate == 0U && read(STDIN_FILENO, peer.message.buffer, 1) == 1) {
  }
  agent_load_wait_until(now_ns() + (int64_t)200 * MILLISECOND);
}

int main(int argc, char ** argv)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);
  bool counts = argc == 6 && strcmp(argv[1], "count") == 0;
  bool sends = argc == 7 && strcmp(argv[1], "send") == 0;
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (!counts && !sends) {
    fprintf(
      stderr,
      "usage: agent_peer count TOPIC COUNT RELIABLE PROGRESS | send TOPIC COUNT RELIABLE SIZE RATE\n");
    return 2;
  }
  open_node();
  peer.message = rmw_get_zero_initialized_serialized_message();
  check(rmw_serialized_message_init(&peer.message, 4096U, &allocator));
  if (counts) {
    rcl_subscription_options_t options = rcl_subscription_get_default_options();
    peer.subscription = rcl_get_zero_initialized_subscription();
    options.qos = keep_all(atoi(argv[4]) != 0);
    check(rcl_subscription_init(&peer.subscription, &peer.node, type, argv[2], &options));
    wait_for_publisher();
    count_samples((uint32_t)strtoul(argv[3], NULL, 10), atoi(argv[5]));
    check(rcl_subscription_fini(&peer.subscription, &peer.node));
  } else {
    rcl_publisher_options_t options = rcl_publisher_get_default_options();
    peer.publisher = rcl_get_zero_initialized_publisher();
    options.qos = keep_all(atoi(argv[4]) != 0);
    check(rcl_publisher_init(&peer.publisher, &peer.node, type, argv[2], &options));
    wait_for_subscription();
    send_samples(
      (uint32_t)strtoul(argv[3], NULL, 10), strtoul(argv[5], NULL, 10), (uint32_t)strtoul(argv[6], NULL, 10));
    check(rcl_publisher_fini(&peer.publisher, &peer.node));
  }
  check(rmw_serialized_message_fini(&peer.message));
  check(rcl_node_fini(&peer.node));
  check(rcl_shutdown(&peer.context));
  check(rcl_context_fini(&peer.context));
  return 0;
}
