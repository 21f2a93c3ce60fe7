/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph_server.h"

#include <string.h>

/* Endpoints of a topic: the request, and where they are stored. */
typedef struct endpoints_list_t {
  char * topic;
  rcl_graph_kind_t kind;
  rmw_topic_endpoint_info_array_t * into;
  rcutils_allocator_t * allocator;
} endpoints_list_t;

static microros_graph_msgs__msg__Endpoint endpoints_page[MICROROS_GRAPH_ENDPOINTS_MAX];

static void endpoints_bind(void * response)
{
  microros_graph_msgs__srv__ListEndpoints_Response * endpoints = response;

  for (size_t i = 0; i < MICROROS_GRAPH_ENDPOINTS_MAX; ++i) {
    rcl_graph_bind_text(&endpoints_page[i].node, (size_t)2u * i);
    rcl_graph_bind_text(&endpoints_page[i].type, (size_t)2u * i + 1u);
  }
  endpoints->endpoints.data = endpoints_page;
  endpoints->endpoints.size = 0;
  endpoints->endpoints.capacity = MICROROS_GRAPH_ENDPOINTS_MAX;
}

static rcl_ret_t endpoints_ask(void * list, uint32_t first, rcl_graph_page_t * page)
{
  const endpoints_list_t * wanted = list;
  microros_graph_msgs__srv__ListEndpoints_Request request;
  microros_graph_msgs__srv__ListEndpoints_Response response;
  rcl_ret_t result;

  (void)memset(&request, 0, sizeof(request));
  request.what = (uint8_t)wanted->kind;
  rcl_graph_lend(&request.name, wanted->topic);
  request.first = first;
  request.version = page->version;
  request.endpoints_max = MICROROS_GRAPH_ENDPOINTS_MAX;
  request.name_size = MICROROS_GRAPH_NAME_SIZE;
  result = rcl_graph_ask(&rcl_graph_endpoints_client, &request, &response, endpoints_bind, NULL);
  if (result != RCL_RET_OK) {
    return result;
  }
  page->version = response.version;
  page->total = response.total;
  page->next = response.next;
  page->size = response.endpoints.size;
  page->truncated = response.truncated;
  return rcl_graph_status(response.status, "the topic", wanted->topic);
}

static rcl_ret_t endpoints_make(void * list, size_t size)
{
  const endpoints_list_t * wanted = list;

  return rmw_topic_endpoint_info_array_init_with_size(wanted->into, size, wanted->allocator);
}

static void endpoints_drop(void * list)
{
  const endpoints_list_t * wanted = list;

  /* Cannot fail: the arguments were checked. */
  (void)rmw_topic_endpoint_info_array_fini(wanted->into, wanted->allocator);
}

static rmw_qos_profile_t endpoints_qos(const microros_graph_msgs__msg__Endpoint * endpoint)
{
  rmw_qos_profile_t qos;

  (void)memset(&qos, 0, sizeof(qos));
  qos.history = (rmw_qos_history_policy_t)endpoint->history;
  qos.depth = (size_t)endpoint->depth;
  qos.reliability = (rmw_qos_reliability_policy_t)endpoint->reliability;
  qos.durability = (rmw_qos_durability_policy_t)endpoint->durability;
  qos.deadline = rmw_time_from_nsec((rmw_duration_t)endpoint->deadline);
  qos.lifespan = rmw_time_from_nsec((rmw_duration_t)endpoint->lifespan);
  qos.liveliness = (rmw_qos_liveliness_policy_t)endpoint->liveliness;
  qos.liveliness_lease_duration = rmw_time_from_nsec((rmw_duration_t)endpoint->lease);
  return qos;
}

static rcl_ret_t endpoints_put(void * list, size_t item, size_t index)
{
  const endpoints_list_t * wanted = list;
  const microros_graph_msgs__msg__Endpoint * endpoint = &endpoints_page[item];
  rmw_topic_endpoint_info_t * info = &wanted->into->info_array[index];
  char * node = NULL;
  char * namespace_ = NULL;
  const rcl_ret_t result =
    rcl_graph_split(endpoint->node.data, endpoint->node.size, wanted->allocator, &node, &namespace_);

  info->node_name = node; /* also after an error: it is freed with the array */
  info->node_namespace = namespace_;
  if (result != RCL_RET_OK) {
    return result;
  }
  info->topic_type = rcl_graph_copy(endpoint->type.data, endpoint->type.size, wanted->allocator);
  if (info->topic_type == NULL) {
    return RCL_RET_BAD_ALLOC;
  }
  info->endpoint_type =
    wanted->kind == RCL_GRAPH_PUBLISHERS ? RMW_ENDPOINT_PUBLISHER : RMW_ENDPOINT_SUBSCRIPTION;
  info->topic_type_hash.version = endpoint->hash_version;
  (void)memcpy(info->topic_type_hash.value, endpoint->hash, sizeof(info->topic_type_hash.value));
  (void)memcpy(info->endpoint_gid, endpoint->gid, sizeof(info->endpoint_gid));
  info->qos_profile = endpoints_qos(endpoint);
  return RCL_RET_OK;
}

rcl_ret_t rcl_graph_list_endpoints(
  rcl_graph_kind_t kind, char * topic, rcutils_allocator_t * allocator,
  rcl_topic_endpoint_info_array_t * into)
{
  static const rcl_graph_reader_t reader = {endpoints_ask, endpoints_make, endpoints_put, endpoints_drop};
  endpoints_list_t list = {topic, kind, into, allocator};

  return rcl_graph_read(&reader, &list);
}
