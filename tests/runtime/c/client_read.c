/* SPDX-License-Identifier: Apache-2.0 */
/* Subscriptions of the application in the hands of the test. */
#include "types.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SUBSCRIPTIONS = 4, LARGEST = 65536 };

int client_read(char ** word, rcl_node_t * node_list);

static rcl_subscription_t subscriptions[SUBSCRIPTIONS];

static const rosidl_message_type_support_t * type_named(const char * name)
{
  return strcmp(name, "String") == 0 ? ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String)
                                     : ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
}

/* read_init INDEX NODE TYPE TOPIC QOS */
static rcl_ret_t init(char ** word, rcl_node_t * node_list)
{
  rcl_subscription_t * subscription = &subscriptions[atoi(word[1])];
  rcl_node_t * node = &node_list[atoi(word[2])];
  const rosidl_message_type_support_t * type = type_named(word[3]);
  rmw_qos_profile_t qos = rmw_qos_profile_default;

  if (strcmp(word[5], "reliable") == 0) {
    return rclc_subscription_init_default(subscription, node, type, word[4]);
  }
  if (strcmp(word[5], "best_effort") == 0) {
    return rclc_subscription_init_best_effort(subscription, node, type, word[4]);
  }
  if (strcmp(word[5], "again") == 0) {
    const rcl_subscription_options_t options = rcl_subscription_get_default_options();

    return rcl_subscription_init(subscription, node, type, word[4], &options);
  }
  if (strcmp(word[5], "longest") == 0) {
    qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
    qos.reliability = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
    qos.depth = 65535;
  } else if (strcmp(word[5], "system_default") == 0) {
    qos = rmw_qos_profile_system_default;
  } else if (strcmp(word[5], "deadline") == 0) {
    qos.deadline.sec = 1;
  }
  return rclc_subscription_init(subscription, node, type, word[4], &qos);
}

static void print_info(const rmw_message_info_t * info)
{
  printf(
    "info %" PRId64 " %" PRId64 " %d\n", info->source_timestamp, info->received_timestamp,
    info->from_intra_process ? 1 : 0);
}

/* read_take INDEX [info] */
static rcl_ret_t take(char ** word)
{
  std_msgs__msg__Int32 message;
  rmw_message_info_t info;
  const bool with_info = strcmp(word[2], "info") == 0;
  const rcl_ret_t result = rcl_take(&subscriptions[atoi(word[1])], &message, with_info ? &info : NULL, NULL);

  if (result == RCL_RET_OK) {
    printf("value %" PRId32 "\n", message.data);
    if (with_info) {
      print_info(&info);
    }
  }
  return result;
}

/* read_text INDEX CAPACITY */
static rcl_ret_t take_text(char ** word)
{
  static char buffer[LARGEST];
  std_msgs__msg__String message;
  rcl_ret_t result;

  message.data.data = buffer;
  message.data.size = 0;
  message.data.capacity = strtoul(word[2], NULL, 10);
  result = rcl_take(&subscriptions[atoi(word[1])], &message, NULL, NULL);
  if (result == RCL_RET_OK) {
    printf("text %s\n", buffer);
  }
  return result;
}

/* read_raw INDEX CAPACITY */
static rcl_ret_t take_raw(char ** word)
{
  static uint8_t bytes[LARGEST];
  rcl_serialized_message_t message = rmw_get_zero_initialized_serialized_message();
  rcl_ret_t result;

  message.buffer = bytes;
  message.buffer_capacity = strtoul(word[2], NULL, 10);
  message.allocator = rcutils_get_zero_initialized_allocator();
  result = rcl_take_serialized_message(&subscriptions[atoi(word[1])], &message, NULL, NULL);
  if (result == RCL_RET_OK) {
    printf("bytes ");
    for (size_t i = 0; i < message.buffer_length; ++i) {
      printf("%02x", message.buffer[i]);
    }
    printf("\n");
  }
  return result;
}

/* read_statistics INDEX */
static rcl_ret_t statistics(char ** word)
{
  rmw_uros_subscription_statistics_t counted;
  const rcl_ret_t result = rmw_uros_get_subscription_statistics(
    rcl_subscription_get_rmw_handle(&subscriptions[atoi(word[1])]), &counted);

  if (result == RCL_RET_OK) {
    printf("counted %" PRIu32 " %" PRIu32 "\n", counted.dropped, counted.refused);
  }
  return result;
}

int client_read(char ** word, rcl_node_t * node_list)
{
  if (strcmp(word[0], "read_init") == 0) {
    return init(word, node_list);
  }
  if (strcmp(word[0], "read_fini") == 0) {
    return rcl_subscription_fini(&subscriptions[atoi(word[1])], &node_list[atoi(word[2])]);
  }
  if (strcmp(word[0], "read_take") == 0) {
    return take(word);
  }
  if (strcmp(word[0], "read_text") == 0) {
    return take_text(word);
  }
  if (strcmp(word[0], "read_raw") == 0) {
    return take_raw(word);
  }
  if (strcmp(word[0], "read_statistics") == 0) {
    return statistics(word);
  }
  if (strcmp(word[0], "read_name") == 0) {
    printf("name %s\n", rcl_subscription_get_topic_name(&subscriptions[atoi(word[1])]));
    return RCL_RET_OK;
  }
  return -1;
}
