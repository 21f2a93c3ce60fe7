/* SPDX-License-Identifier: Apache-2.0 */
/* Queries of the graph as the test requests them, one in a line; the results are printed, one name in a line. */
#ifndef GRAPH_CALLS_H
#define GRAPH_CALLS_H

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rcl_action/graph.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>
#include <std_srvs/srv/set_bool.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rcl_client_t client;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static unsigned changes; /* that the executor has seen */

static void calls_changed(void)
{
  ++changes;
}

static rcl_ret_t calls_open_node(void)
{
  rcl_ret_t result = rclc_node_init_default(&node, "device", "arm", &support);

  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count");
  }
  if (result == RCL_RET_OK) {
    result = rclc_subscription_init_default(
      &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "order");
  }
  if (result == RCL_RET_OK) {
    result =
      rclc_client_init_default(&client, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool), "set");
  }
  return result;
}

static rcl_ret_t calls_open(void)
{
  rcl_ret_t result;

  allocator = rcl_get_default_allocator();
  result = rclc_support_init(&support, 0, NULL, &allocator);
  if (result == RCL_RET_OK) {
    result = calls_open_node();
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_init(&executor, &support.context, 1, &allocator);
  }
  if (result == RCL_RET_OK) {
    rcl_guard_condition_t changed = *rcl_node_get_graph_guard_condition(&node);
    static rcl_guard_condition_t condition;

    condition = changed;
    result = rclc_executor_add_guard_condition(&executor, &condition, calls_changed);
  }
  return result;
}

static rcl_ret_t calls_close(void)
{
  rcl_ret_t result = rclc_executor_fini(&executor);

  if (result == RCL_RET_OK) {
    result = rcl_client_fini(&client, &node);
  }
  if (result == RCL_RET_OK) {
    result = rcl_subscription_fini(&subscription, &node);
  }
  if (result == RCL_RET_OK) {
    result = rcl_publisher_fini(&publisher, &node);
  }
  if (result == RCL_RET_OK) {
    result = rcl_node_fini(&node);
  }
  return result == RCL_RET_OK ? rclc_support_fini(&support) : result;
}

/* Prints a text of a response, of which a test may have changed any byte. */
static void calls_print_text(const char * text)
{
  printf(" ");
  for (; *text != '\0'; ++text) {
    printf("%c", *text >= ' ' && *text <= '~' ? *text : '?');
  }
}

static rcl_ret_t calls_print_names(rcl_ret_t result, rcl_names_and_types_t * found)
{
  if (result != RCL_RET_OK) {
    if (found->names.data != NULL || found->types != NULL) {
      abort(); /* nothing is left after an error */
    }
    return result;
  }
  for (size_t i = 0; i < found->names.size; ++i) {
    printf("item");
    calls_print_text(found->names.data[i]);
    for (size_t j = 0; j < found->types[i].size; ++j) {
      calls_print_text(found->types[i].data[j]);
    }
    printf("\n");
  }
  return rcl_names_and_types_fini(found);
}

static rcl_ret_t calls_names(const char * what, const char * name, const char * namespace_)
{
  rcl_names_and_types_t found = rcl_get_zero_initialized_names_and_types();
  rcl_ret_t result;

  if (strcmp(what, "topics") == 0) {
    result = rcl_get_topic_names_and_types(&node, &allocator, false, &found);
  } else if (strcmp(what, "mangled") == 0) {
    result = rcl_get_topic_names_and_types(&node, &allocator, true, &found);
  } else if (strcmp(what, "services") == 0) {
    result = rcl_get_service_names_and_types(&node, &allocator, &found);
  } else if (strcmp(what, "mangled_publishers_of") == 0) {
    result = rcl_get_publisher_names_and_types_by_node(&node, &allocator, true, name, namespace_, &found);
  } else if (strcmp(what, "mangled_subscriptions_of") == 0) {
    result = rcl_get_subscriber_names_and_types_by_node(&node, &allocator, true, name, namespace_, &found);
  } else if (strcmp(what, "publishers_of") == 0) {
    result = rcl_get_publisher_names_and_types_by_node(&node, &allocator, false, name, namespace_, &found);
  } else if (strcmp(what, "subscriptions_of") == 0) {
    result = rcl_get_subscriber_names_and_types_by_node(&node, &allocator, false, name, namespace_, &found);
  } else if (strcmp(what, "actions") == 0) {
    result = rcl_action_get_names_and_types(&node, &allocator, &found);
  } else if (strcmp(what, "action_servers_of") == 0) {
    result = rcl_action_get_server_names_and_types_by_node(&node, &allocator, name, namespace_, &found);
  } else if (strcmp(what, "action_clients_of") == 0) {
    result = rcl_action_get_client_names_and_types_by_node(&node, &allocator, name, namespace_, &found);
  } else if (strcmp(what, "services_of") == 0) {
    result = rcl_get_service_names_and_types_by_node(&node, &allocator, name, namespace_, &found);
  } else {
    result = rcl_get_client_names_and_types_by_node(&node, &allocator, name, namespace_, &found);
  }
  return calls_print_names(result, &found);
}

static rcl_ret_t calls_nodes(void)
{
  rcutils_string_array_t names = rcutils_get_zero_initialized_string_array();
  rcutils_string_array_t namespaces = rcutils_get_zero_initialized_string_array();
  const rcl_ret_t result = rcl_get_node_names(&node, allocator, &names, &namespaces);

  if (result != RCL_RET_OK) {
    if (names.data != NULL || namespaces.data != NULL) {
      abort();
    }
    return result;
  }
  for (size_t i = 0; i < names.size; ++i) {
    printf("item");
    calls_print_text(namespaces.data[i]);
    calls_print_text(names.data[i]);
    printf("\n");
  }
  if (rcutils_string_array_fini(&names) != RCUTILS_RET_OK) {
    return RCL_RET_ERROR;
  }
  return rcutils_string_array_fini(&namespaces) == RCUTILS_RET_OK ? RCL_RET_OK : RCL_RET_ERROR;
}

static rcl_ret_t calls_free(
  rcutils_string_array_t * names, rcutils_string_array_t * namespaces, rcutils_string_array_t * enclaves)
{
  const rcutils_ret_t first = rcutils_string_array_fini(names);
  const rcutils_ret_t second = rcutils_string_array_fini(namespaces);
  const rcutils_ret_t third = rcutils_string_array_fini(enclaves);

  return first == RCUTILS_RET_OK && second == RCUTILS_RET_OK && third == RCUTILS_RET_OK ? RCL_RET_OK
                                                                                        : RCL_RET_ERROR;
}

static rcl_ret_t calls_enclaves(void)
{
  rcutils_string_array_t names = rcutils_get_zero_initialized_string_array();
  rcutils_string_array_t namespaces = rcutils_get_zero_initialized_string_array();
  rcutils_string_array_t enclaves = rcutils_get_zero_initialized_string_array();
  const rcl_ret_t result = rcl_get_node_names_with_enclaves(&node, allocator, &names, &namespaces, &enclaves);

  if (result != RCL_RET_OK) {
    if (names.data != NULL || namespaces.data != NULL || enclaves.data != NULL) {
      abort();
    }
    return result;
  }
  for (size_t i = 0; i < names.size; ++i) {
    printf("item");
    calls_print_text(namespaces.data[i]);
    calls_print_text(names.data[i]);
    calls_print_text(enclaves.data[i]);
    printf("\n");
  }
  /* Lists that are not empty are refused. */
  if (
    names.size != 0u && rcl_get_node_names_with_enclaves(&node, allocator, &names, &namespaces, &enclaves) !=
                          RCL_RET_INVALID_ARGUMENT) {
    abort();
  }
  return calls_free(&names, &namespaces, &enclaves);
}

static void calls_print_bytes(const uint8_t * bytes, size_t size)
{
  printf(" ");
  for (size_t i = 0; i < size; ++i) {
    printf("%02x", bytes[i]);
  }
}

static void calls_print_time(rmw_time_t time)
{
  printf(" %" PRIu64 ".%09" PRIu64, time.sec, time.nsec);
}

static rcl_ret_t calls_infos(bool publishers, const char * topic)
{
  rcl_topic_endpoint_info_array_t found = rcl_get_zero_initialized_topic_endpoint_info_array();
  const rcl_ret_t result = publishers
                             ? rcl_get_publishers_info_by_topic(&node, &allocator, topic, false, &found)
                             : rcl_get_subscriptions_info_by_topic(&node, &allocator, topic, false, &found);

  if (result != RCL_RET_OK) {
    if (found.info_array != NULL || found.size != 0u) {
      abort();
    }
    return result;
  }
  for (size_t i = 0; i < found.size; ++i) {
    const rcl_topic_endpoint_info_t * info = &found.info_array[i];
    const rmw_qos_profile_t * qos = &info->qos_profile;

    printf("item");
    calls_print_text(info->node_namespace);
    calls_print_text(info->node_name);
    calls_print_text(info->topic_type);
    printf(" %d %u", (int)info->endpoint_type, (unsigned)info->topic_type_hash.version);
    calls_print_bytes(info->topic_type_hash.value, sizeof(info->topic_type_hash.value));
    calls_print_bytes(info->endpoint_gid, sizeof(info->endpoint_gid));
    printf(
      " %d %d %d %d %u", (int)qos->reliability, (int)qos->durability, (int)qos->history, (int)qos->liveliness,
      (unsigned)qos->depth);
    calls_print_time(qos->deadline);
    calls_print_time(qos->lifespan);
    calls_print_time(qos->liveliness_lease_duration);
    printf("\n");
  }
  return rcl_topic_endpoint_info_array_fini(&found, &allocator);
}

static rcl_ret_t calls_count(const char * what, const char * name)
{
  size_t count = 9999;
  rcl_ret_t result;

  if (strcmp(what, "publishers") == 0) {
    result = rcl_count_publishers(&node, name, &count);
  } else if (strcmp(what, "subscriptions") == 0) {
    result = rcl_count_subscribers(&node, name, &count);
  } else if (strcmp(what, "clients") == 0) {
    result = rcl_count_clients(&node, name, &count);
  } else if (strcmp(what, "servers") == 0) {
    result = rcl_count_services(&node, name, &count);
  } else if (strcmp(what, "matched_subscriptions") == 0) {
    result = rcl_publisher_get_subscription_count(&publisher, &count);
  } else if (strcmp(what, "matched_publishers") == 0) {
    result = rcl_subscription_get_publisher_count(&subscription, &count);
  } else {
    bool is_available = false;

    result = rcl_service_server_is_available(&node, &client, &is_available);
    count = is_available ? 1u : 0u;
  }
  if (result == RCL_RET_OK) {
    printf("count %u\n", (unsigned)count);
  }
  return result;
}

static rcl_ret_t calls_wait_for(const char * what, const char * topic, size_t count, int64_t timeout_ms)
{
  bool success = true;
  const rcl_ret_t result =
    strcmp(what, "publishers") == 0
      ? rcl_wait_for_publishers(&node, &allocator, topic, count, RCL_MS_TO_NS(timeout_ms), &success)
      : rcl_wait_for_subscribers(&node, &allocator, topic, count, RCL_MS_TO_NS(timeout_ms), &success);

  if (success != (result == RCL_RET_OK)) {
    abort();
  }
  return result;
}

/* Waits for a change in a wait set. */
static rcl_ret_t calls_await_change(int64_t timeout_ms)
{
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  rcl_ret_t result = rcl_wait_set_init(&wait_set, 0, 1, 0, 0, 0, 0, &support.context, allocator);

  if (result == RCL_RET_OK) {
    result = rcl_wait_set_add_guard_condition(&wait_set, rcl_node_get_graph_guard_condition(&node), NULL);
  }
  if (result == RCL_RET_OK) {
    result = rcl_wait(&wait_set, RCL_MS_TO_NS(timeout_ms));
    if ((wait_set.guard_conditions[0] != NULL) != (result == RCL_RET_OK)) {
      abort();
    }
    if (rcl_wait_set_fini(&wait_set) != RCL_RET_OK) {
      return RCL_RET_ERROR;
    }
  }
  return result;
}

static rcl_ret_t calls_call(char * line)
{
  const char * word[4] = {"", "", "", ""};
  size_t words = 0;

  for (char * at = strtok(line, " "); at != NULL && words < 4u; at = strtok(NULL, " ")) {
    word[words++] = at;
  }
  if (strcmp(word[0], "init") == 0) {
    return calls_open();
  }
  if (strcmp(word[0], "end") == 0) {
    return calls_close();
  }
  if (strcmp(word[0], "names") == 0) {
    return calls_names(word[1], word[2], word[3]);
  }
  if (strcmp(word[0], "nodes") == 0) {
    return calls_nodes();
  }
  if (strcmp(word[0], "enclaves") == 0) {
    return calls_enclaves();
  }
  if (strcmp(word[0], "infos") == 0) {
    return calls_infos(strcmp(word[1], "publishers") == 0, word[2]);
  }
  if (strcmp(word[0], "count") == 0) {
    return calls_count(word[1], word[2]);
  }
  if (strcmp(word[0], "wait") == 0) {
    return calls_wait_for(word[1], word[2], 2, atoi(word[3]));
  }
  if (strcmp(word[0], "change") == 0) {
    return calls_await_change(atoi(word[1]));
  }
  if (strcmp(word[0], "changes") == 0) {
    printf("count %u\n", changes);
    return RCL_RET_OK;
  }
  return rclc_executor_spin_some(&executor, (uint64_t)RCL_MS_TO_NS(atoi(word[1])));
}

static void calls_report(rcl_ret_t result)
{
  printf("ret %d %s\n", (int)result, rcl_get_error_string().str);
  rcl_reset_error();
  (void)fflush(stdout);
}

#endif /* GRAPH_CALLS_H */
