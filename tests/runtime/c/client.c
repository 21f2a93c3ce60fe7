/* SPDX-License-Identifier: Apache-2.0 */
/* An application in the hands of the test: one call for each line of standard input. */
#include "fake_program.h"
#include "client.h"
#include "types.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <rosidl_runtime_c/string_functions.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NODES = 4, PUBLISHERS = 6, WORDS = 6, COMMAND = 1024 };

static rclc_support_t support;
static rcl_init_options_t options;
static rcl_node_t nodes[NODES];
rcl_publisher_t publishers[PUBLISHERS];
static rcl_allocator_t allocator;

static rcl_ret_t init_with_options(char ** word)
{
  rcl_ret_t result = rcl_init_options_init(&options, allocator);

  if (result == RCL_RET_OK) {
    result = rcl_init_options_set_domain_id(&options, strtoul(word[1], NULL, 10));
  }
  if (result == RCL_RET_OK) {
    rmw_init_options_t * rmw = rcl_init_options_get_rmw_init_options(&options);

#ifdef RMW_UXRCE_TRANSPORT_UDP
    result = rmw_uros_options_set_udp_address(word[2], word[3], rmw);
#endif
    if (result == RCL_RET_OK) {
      result = rmw_uros_options_set_client_key((uint32_t)strtoul(word[4], NULL, 16), rmw);
    }
  }
  if (result == RCL_RET_OK) {
    result = rclc_support_init_with_options(&support, 0, NULL, &options, &allocator);
  }
  return result;
}

static const rosidl_message_type_support_t * type_named(const char * name)
{
  return strcmp(name, "String") == 0 ? ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String)
                                     : ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
}

/* publisher INDEX NODE TYPE TOPIC QOS */
static rcl_ret_t init_publisher(char ** word)
{
  rcl_publisher_t * publisher = &publishers[atoi(word[1])];
  const rcl_node_t * node = &nodes[atoi(word[2])];
  const rosidl_message_type_support_t * type = type_named(word[3]);
  rmw_qos_profile_t qos = rmw_qos_profile_default;

  if (strcmp(word[5], "reliable") == 0) {
    return rclc_publisher_init_default(publisher, node, type, word[4]);
  }
  if (strcmp(word[5], "best_effort") == 0) {
    return rclc_publisher_init_best_effort(publisher, node, type, word[4]);
  }
  if (strcmp(word[5], "system_default") == 0) {
    qos = rmw_qos_profile_system_default;
  } else if (strcmp(word[5], "transient_local") == 0) {
    qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  } else if (strcmp(word[5], "longest") == 0) {
    qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
    qos.reliability = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
    qos.depth = 65535;
  } else if (strcmp(word[5], "keep_all") == 0) {
    qos.history = RMW_QOS_POLICY_HISTORY_KEEP_ALL;
  } else if (strcmp(word[5], "deadline") == 0) {
    qos.deadline.sec = 1;
  } else if (strcmp(word[5], "lifespan") == 0) {
    qos.lifespan.nsec = 1;
  } else if (strcmp(word[5], "liveliness") == 0) {
    qos.liveliness = RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC;
  } else if (strcmp(word[5], "best_available") == 0) {
    qos = rmw_qos_profile_best_available;
  } else if (strcmp(word[5], "depth") == 0) {
    qos.depth = 65536;
  } else if (strcmp(word[5], "bare_names") == 0) {
    qos.avoid_ros_namespace_conventions = true;
  }
  return rclc_publisher_init(publisher, node, type, word[4], &qos);
}

/* publish INDEX NUMBER */
static rcl_ret_t publish(char ** word)
{
  std_msgs__msg__Int32 message;

  message.data = (int32_t)strtol(word[2], NULL, 10);
  return rcl_publish(&publishers[atoi(word[1])], &message, NULL);
}

/* say INDEX WORD */
static rcl_ret_t say(char ** word)
{
  std_msgs__msg__String message;

  message.data.data = word[2];
  message.data.size = strlen(word[2]);
  message.data.capacity = message.data.size + 1u;
  return rcl_publish(&publishers[atoi(word[1])], &message, NULL);
}

/* raw INDEX SIZE: a serialized message */
static rcl_ret_t publish_raw(char ** word)
{
  uint8_t bytes[256] = {0, 1, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8};
  rcl_serialized_message_t message = rmw_get_zero_initialized_serialized_message();

  message.buffer = bytes;
  message.buffer_length = strtoul(word[2], NULL, 10);
  message.buffer_capacity = sizeof(bytes);
  bytes[1] = (uint8_t)strtoul(word[3], NULL, 10);
  return rcl_publish_serialized_message(&publishers[atoi(word[1])], &message, NULL);
}

/* large INDEX SIZE SEED: a serialized message whose bytes follow from the seed */
static rcl_ret_t publish_large(char ** word)
{
  static uint8_t bytes[65536] = {0, 1, 0, 0};
  const uint32_t seed = (uint32_t)strtoul(word[3], NULL, 10);
  rcl_serialized_message_t message = rmw_get_zero_initialized_serialized_message();

  message.buffer = bytes;
  message.buffer_length = 4u + strtoul(word[2], NULL, 10);
  message.buffer_capacity = sizeof(bytes);
  for (uint32_t i = 4; i < message.buffer_length; ++i) {
    bytes[i] = (uint8_t)((seed * 31u + (i - 4u) * 7u + (i - 4u) / 256u) & 0xffu);
  }
  return rcl_publish_serialized_message(&publishers[atoi(word[1])], &message, NULL);
}

static rcl_ret_t print_statistics(void)
{
  rmw_uros_statistics_t s;
  const rcl_ret_t result = rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &s);

  if (result == RCL_RET_OK) {
    printf(
      "statistics sent=%" PRIu32 " resent=%" PRIu32 " received=%" PRIu32 " malformed=%" PRIu32
      " dropped=%" PRIu32 " reconnects=%" PRIu32 " refused=%" PRIu32 "\n",
      s.sent, s.resent, s.received, s.malformed, s.dropped, s.reconnects, s.refused);
  }
  return result;
}

static rcl_ret_t print_names(char ** word)
{
  size_t domain = 0;
  const rcl_ret_t result = rcl_node_get_domain_id(&nodes[atoi(word[1])], &domain);

  printf(
    "names %s %s %s %u\n", rcl_node_get_name(&nodes[atoi(word[1])]),
    rcl_node_get_namespace(&nodes[atoi(word[1])]), rcl_publisher_get_topic_name(&publishers[atoi(word[2])]),
    (unsigned)domain);
  return result;
}

static rcl_ret_t call_session(char ** word)
{
  rmw_context_t * context = rcl_context_get_rmw_context(&support.context);

  if (strcmp(word[0], "init") == 0) {
    return rclc_support_init(&support, 0, NULL, &allocator);
  }
  if (strcmp(word[0], "init_options") == 0) {
    return init_with_options(word);
  }
  if (strcmp(word[0], "fini") == 0) {
    return rclc_support_fini(&support);
  }
  if (strcmp(word[0], "spin") == 0) {
    return rmw_uros_spin_once(context);
  }
  if (strcmp(word[0], "flush") == 0) {
    return rmw_uros_flush(context, (uint32_t)strtoul(word[1], NULL, 10));
  }
  if (strcmp(word[0], "connected") == 0) {
    return rmw_uros_is_connected(context) ? 1 : 0;
  }
  if (strcmp(word[0], "destroy_timeout") == 0) {
    return rmw_uros_set_context_entity_destroy_session_timeout(context, atoi(word[1]));
  }
  if (strcmp(word[0], "statistics") == 0) {
    return print_statistics();
  }
  return -1;
}

static rcl_ret_t call_entity(char ** word)
{
  if (strcmp(word[0], "node") == 0) {
    return rclc_node_init_default(
      &nodes[atoi(word[1])], word[2], strcmp(word[3], "-") == 0 ? "" : word[3], &support);
  }
  if (strcmp(word[0], "node_fini") == 0) {
    return rcl_node_fini(&nodes[atoi(word[1])]);
  }
  if (strcmp(word[0], "publisher") == 0) {
    return init_publisher(word);
  }
  if (strcmp(word[0], "publisher_fini") == 0) {
    return rcl_publisher_fini(&publishers[atoi(word[1])], &nodes[atoi(word[2])]);
  }
  if (strcmp(word[0], "publish") == 0) {
    return publish(word);
  }
  if (strcmp(word[0], "say") == 0) {
    return say(word);
  }
  if (strcmp(word[0], "raw") == 0) {
    return publish_raw(word);
  }
  if (strcmp(word[0], "large") == 0) {
    return publish_large(word);
  }
  if (strcmp(word[0], "acked") == 0) {
    return rcl_publisher_wait_for_all_acked(
      &publishers[atoi(word[1])], RCL_MS_TO_NS(strtol(word[2], NULL, 10)));
  }
  if (strcmp(word[0], "names") == 0) {
    return print_names(word);
  }
  return call_session(word);
}

int client_ping(char ** word);                            /* client_ping.c, or client_no_ping.c */
int client_read(char ** word, rcl_node_t * node_list);    /* client_read.c, or client_no_read.c */
int client_time(char ** word);                            /* client_time.c, or client_no_time.c */
int client_extra(char ** word, rclc_support_t * session); /* client_extra.c, or client_no_extra.c */
int client_serve(char ** word, rcl_node_t * node_list);   /* client_serve.c, or client_no_serve.c */

static rcl_ret_t call(const char * line)
{
  static char nothing[] = "";
  char command[COMMAND]; /* the line is read again while the library sleeps */
  char * word[WORDS] = {nothing, nothing, nothing, nothing, nothing, nothing};
  char * at;

  if (strlen(line) >= sizeof(command)) {
    abort();
  }
  strcpy(command, line);
  at = strtok(command, " ");
  for (size_t i = 0; i < WORDS && at != NULL; ++i) {
    word[i] = at;
    at = strtok(NULL, " ");
  }
  if (strncmp(word[0], "serve_", 6) == 0) {
    return client_serve(word, nodes);
  }
  if (strncmp(word[0], "read_", 5) == 0) {
    return client_read(word, nodes);
  }
  if (strncmp(word[0], "epoch_", 6) == 0) {
    return client_time(word);
  }
  if (strncmp(word[0], "extra_", 6) == 0) {
    return client_extra(word, &support);
  }
  return strncmp(word[0], "ping", 4) == 0 ? client_ping(word) : call_entity(word);
}

static void work(char * line)
{
  report_result(call(line));
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  return run_calls(work);
}
