/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An application in the hands of the test, over a real network and in real time: one call for each line of
 * standard input. Each is answered with "ret CODE MICROSECONDS TEXT"; meanwhile the session is carried on.
 */
#define _POSIX_C_SOURCE 200809L
#include <poll.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/string.h>

enum { NODES = 3, PUBLISHERS = 4, WORDS = 6, COMMAND = 512, LATCHED = 100 };

static rclc_support_t support;
static rcl_init_options_t options;
static rcl_node_t nodes[NODES];
static rcl_publisher_t publishers[PUBLISHERS];
static rcl_allocator_t allocator;
static bool is_open;

static long number(const char * word)
{
  return strtol(word, NULL, 0);
}

static int64_t now_us(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

/* open KEY PORT; without a port (-), where the plan says */
static rcl_ret_t open_session(char ** word)
{
  rmw_init_options_t * rmw;
  rcl_ret_t result;

  options = rcl_get_zero_initialized_init_options();
  result = rcl_init_options_init(&options, allocator);
  rmw = rcl_init_options_get_rmw_init_options(&options);
#ifndef LIVE_NO_UDP
  if (result == RCL_RET_OK && strcmp(word[2], "-") != 0) {
    result = rmw_uros_options_set_udp_address("127.0.0.1", word[2], rmw);
  }
#endif
  if (result == RCL_RET_OK) {
    result = rmw_uros_options_set_client_key((uint32_t)number(word[1]), rmw);
  }
  if (result == RCL_RET_OK) {
    result = rclc_support_init_with_options(&support, 0, NULL, &options, &allocator);
  }
  is_open = result == RCL_RET_OK;
  return result;
}

/* publisher INDEX NODE TYPE TOPIC QOS */
static rcl_ret_t open_publisher(char ** word)
{
  const rosidl_message_type_support_t * type = strcmp(word[3], "String") == 0
                                                 ? ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String)
                                                 : ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_publisher_t * publisher = &publishers[number(word[1])];
  const rcl_node_t * node = &nodes[number(word[2])];
  rmw_qos_profile_t qos = rmw_qos_profile_default;

  if (strcmp(word[5], "latched") == 0) {
    qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
    qos.depth = LATCHED;
    return rclc_publisher_init(publisher, node, type, word[4], &qos);
  }
  return strcmp(word[5], "best_effort") == 0 ? rclc_publisher_init_best_effort(publisher, node, type, word[4])
                                             : rclc_publisher_init_default(publisher, node, type, word[4]);
}

static rcl_ret_t publish(const rcl_publisher_t * publisher, int32_t value)
{
  std_msgs__msg__Int32 message;

  message.data = value;
  return rcl_publish(publisher, &message, NULL);
}

/* burst INDEX FIRST COUNT PERIOD_MS: the answer of each call as "sample VALUE CODE MICROSECONDS" */
static rcl_ret_t burst(char ** word)
{
  const int32_t first = (int32_t)number(word[2]);
  rcl_ret_t last = RCL_RET_OK;

  for (int32_t i = 0; i < number(word[3]); ++i) {
    const int64_t start = now_us();
    const rcl_ret_t result = publish(&publishers[number(word[1])], first + i);

    printf("sample %d %d %d\n", (int)(first + i), (int)result, (int)(now_us() - start));
    last = result != RCL_RET_OK ? result : last;
    rclc_sleep_ms((unsigned)number(word[4]));
  }
  return last;
}

static rcl_ret_t say(char ** word)
{
  std_msgs__msg__String message;

  message.data.data = word[2];
  message.data.size = strlen(word[2]);
  message.data.capacity = message.data.size + 1u;
  return rcl_publish(&publishers[number(word[1])], &message, NULL);
}

static rcl_ret_t print_statistics(void)
{
  rmw_uros_statistics_t s;
  const rcl_ret_t result = rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &s);

  if (result == RCL_RET_OK) {
    printf(
      "statistics sent=%u resent=%u received=%u malformed=%u dropped=%u reconnects=%u refused=%u\n",
      (unsigned)s.sent, (unsigned)s.resent, (unsigned)s.received, (unsigned)s.malformed, (unsigned)s.dropped,
      (unsigned)s.reconnects, (unsigned)s.refused);
  }
  return result;
}

/* ping MS ATTEMPTS, where the plan or the session says; ping_at PORT MS ATTEMPTS */
static rcl_ret_t ping(char ** word)
{
#ifdef LIVE_PING
#ifndef LIVE_NO_UDP
  if (strcmp(word[0], "ping_at") == 0) {
    rcl_init_options_t place = rcl_get_zero_initialized_init_options();
    rmw_init_options_t * rmw;
    rcl_ret_t result = rcl_init_options_init(&place, allocator);

    rmw = rcl_init_options_get_rmw_init_options(&place);
    if (result == RCL_RET_OK) {
      result = rmw_uros_options_set_udp_address("127.0.0.1", word[1], rmw);
    }
    if (result == RCL_RET_OK) {
      result = rmw_uros_ping_agent_options((int)number(word[2]), (uint8_t)number(word[3]), rmw);
    }
    return rcl_init_options_fini(&place) == RCL_RET_OK ? result : RCL_RET_ERROR;
  }
#endif
  return rmw_uros_ping_agent((int)number(word[1]), (uint8_t)number(word[2]));
#else
  (void)word;
  return -1;
#endif
}

/* The agent as "agent HOST PORT INDEX CHANGES" */
static rcl_ret_t print_agent(void)
{
#ifdef LIVE_AGENTS
  rmw_uros_agent_t agent;
  const rcl_ret_t result = rmw_uros_get_agent(rcl_context_get_rmw_context(&support.context), &agent);

  if (result == RCL_RET_OK) {
    printf(
      "agent %s %u %u %u\n", agent.host, (unsigned)agent.port, (unsigned)agent.index,
      (unsigned)agent.changes);
  }
  return result;
#else
  return -1;
#endif
}

/* sync MS: asks for the time; epoch: the time as "epoch SECONDS SYNCHRONIZED" */
static rcl_ret_t call_time(char ** word)
{
#ifdef LIVE_TIME
  if (strcmp(word[0], "sync") == 0) {
    return rmw_uros_sync_session((int)number(word[1]));
  }
  printf(
    "epoch %lld %d\n", (long long)(rmw_uros_epoch_millis() / 1000), (int)rmw_uros_epoch_synchronized());
  return RCL_RET_OK;
#else
  (void)word;
  return -1;
#endif
}

static rcl_ret_t call_session(char ** word)
{
  rmw_context_t * context = rcl_context_get_rmw_context(&support.context);

  if (strcmp(word[0], "agent") == 0) {
    return print_agent();
  }
  if (strcmp(word[0], "sync") == 0 || strcmp(word[0], "epoch") == 0) {
    return call_time(word);
  }
  if (strcmp(word[0], "open") == 0) {
    return open_session(word);
  }
  if (strcmp(word[0], "close") == 0) {
    is_open = false;
    return rclc_support_fini(&support);
  }
  if (strcmp(word[0], "flush") == 0) {
    return rmw_uros_flush(context, (uint32_t)number(word[1]));
  }
  if (strcmp(word[0], "connected") == 0) {
    return rmw_uros_is_connected(context) ? 1 : 0;
  }
  return strcmp(word[0], "statistics") == 0 ? print_statistics() : ping(word);
}

static rcl_ret_t call(char ** word)
{
  if (strcmp(word[0], "node") == 0) {
    const char * space = strcmp(word[3], "-") == 0 ? "" : word[3];

    return rclc_node_init_default(&nodes[number(word[1])], word[2], space, &support);
  }
  if (strcmp(word[0], "publisher") == 0) {
    return open_publisher(word);
  }
  if (strcmp(word[0], "publisher_fini") == 0) {
    return rcl_publisher_fini(&publishers[number(word[1])], &nodes[number(word[2])]);
  }
  if (strcmp(word[0], "publish") == 0) {
    return publish(&publishers[number(word[1])], (int32_t)number(word[2]));
  }
  if (strcmp(word[0], "burst") == 0) {
    return burst(word);
  }
  return strcmp(word[0], "say") == 0 ? say(word) : call_session(word);
}

/* Runs the session until a line is available; false at the end of input. */
static bool read_line(char * line)
{
  struct pollfd input = {0, POLLIN, 0};

  while (poll(&input, 1, 5) == 0) {
    if (is_open && rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)) != RMW_RET_OK) {
      abort();
    }
  }
  return fgets(line, COMMAND, stdin) != NULL;
}

int main(void)
{
  static char nothing[] = "";
  char line[COMMAND];

  (void)setvbuf(stdin, NULL, _IONBF, 0);
  allocator = rcl_get_default_allocator();
  while (read_line(line)) {
    char * word[WORDS] = {nothing, nothing, nothing, nothing, nothing, nothing};
    char * at = strtok(line, " \n");
    int64_t start;
    rcl_ret_t result;

    for (size_t i = 0; i < WORDS && at != NULL; ++i) {
      word[i] = at;
      at = strtok(NULL, " \n");
    }
    start = now_us();
    result = call(word);
    printf("ret %d %d %s\n", (int)result, (int)(now_us() - start), rcl_get_error_string().str);
    rcl_reset_error();
    (void)fflush(stdout);
  }
  return 0;
}
