/* SPDX-License-Identifier: Apache-2.0 */
/* Service clients. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_client.h"
#include "microros/rmw_local_service.h"
#include "microros/rmw_node.h"
#include "microros/rmw_peer_client.h"
#include "microros/rmw_service.h"
#include "microros/xrce_client.h"
#include "microros/xrce_place.h"
#include "microros/xrce_wire.h"
#include "rmw_microros/service.h"

#include <stddef.h>
#include <string.h>

static rmw_ret_t requester_open(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, const char * name,
  const rmw_qos_profile_t * qos, rmw_client_t ** client)
{
  static rmw_client_t clients[MICROROS_CLIENTS_MAX]; /* indexed by place */
  const microros_service_type_t * type = type_support->data;
  const xrce_service_t opened = {type, type->request};
  const rmw_section_t section = {
    XRCE_REQUESTERS_AT - MICROROS_NODES_MAX,
    MICROROS_CLIENTS_MAX,
    microros_error_client_undeclared,
    microros_error_client_open,
    microros_error_of_pool(microros_error_clients_full, MICROROS_CLIENTS_MAX),
    type->dds_type_name};
  xrce_endpoint_t wanted = {
    .client = node->context->impl, .type = type->response, .participant = rmw_node_index(node)};
  const rmw_ret_t result = rmw_service_open(&wanted, &opened, &section, node, name, qos);

  if (result == RMW_RET_OK) {
    xrce_endpoint_t * endpoint = &wanted.client->endpoints[wanted.index];

    if (!xrce_place_was_restored(endpoint->client, (uint16_t)(MICROROS_NODES_MAX + endpoint->index))) {
      xrce_requests_open(endpoint);
    }
    *client = &clients[wanted.index - section.first];
    (*client)->implementation_identifier = rmw_implementation_identifier;
    (*client)->data = endpoint;
    (*client)->service_name = endpoint->name;
  }
  return result;
}

rmw_ret_t rmw_requester_open(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, const char * name,
  const rmw_qos_profile_t * qos, rmw_client_t ** client)
{
  rmw_ret_t result;

  microros_lock();
  result = requester_open(node, type_support, name, qos, client);
  microros_unlock();
  return result;
}

void rmw_requester_close(rmw_client_t * client)
{
  rmw_receiver_close(client->data);
}

bool rmw_requester_is_open(const rmw_client_t * client)
{
  if (client == NULL || client->data == NULL) {
    return false;
  }
  return rmw_receiver_is_open(client->data);
}

static bool requester_is_ready(const rmw_client_t * client)
{
  return rmw_local_waits(client->data) || xrce_read_is_ready(client->data) ||
         xrce_requests_of(client->data)->unreported != 0u;
}

bool rmw_requester_is_ready(const rmw_client_t * client)
{
  bool result;

  microros_lock();
  result = requester_is_ready(client);
  microros_unlock();
  return result;
}

void rmw_requester_pump(const rmw_client_t * client)
{
  const xrce_endpoint_t * endpoint = client->data;

  microros_lock();
  xrce_session_pump(endpoint->client);
  microros_unlock();
}

/* XRCE does not carry the GUID that DDS assigned. */
static void requester_identify(const xrce_endpoint_t * endpoint, rmw_request_id_t * request)
{
  (void)memset(request->writer_guid, 0, sizeof(request->writer_guid));
  xrce_put_be16(request->writer_guid, xrce_object_id(endpoint->index, XRCE_KIND_REQUESTER));
}

/* Finds the request of a reply; false if it is not outstanding or the sample is not a reply. */
static bool requester_match(
  const xrce_endpoint_t * endpoint, const xrce_sample_t * sample, rmw_request_id_t * request)
{
  const uint16_t object = xrce_object_id(endpoint->index, XRCE_KIND_REQUESTER);

  if (
    sample->size < XRCE_RELATED_SIZE || xrce_get_be16(&sample->data[2]) != object ||
    !xrce_requests_take(endpoint, xrce_get_be16(sample->data), &request->sequence_number)) {
    return false;
  }
  requester_identify(endpoint, request);
  return true;
}

/* Reports once that requests were outstanding when a session was lost. */
static bool requester_report(const xrce_endpoint_t * endpoint)
{
  xrce_requester_t * requester = xrce_requests_of(endpoint);

  if (requester->unreported == 0u) {
    return rmw_receiver_report(endpoint);
  }
  microros_error_set(microros_error_requests_lost, endpoint->name, NULL, requester->unreported, 0);
  requester->unreported = 0;
  return true;
}

static rmw_ret_t requester_take(
  const rmw_client_t * client, rmw_service_info_t * info, void * ros_response, bool * taken)
{
  const xrce_endpoint_t * endpoint = client->data;
  xrce_sample_t sample;
  uint16_t number;
  rmw_ret_t result;

  *taken = false;
  while (rmw_local_find_reply(endpoint, &number)) {
    if (xrce_requests_take(endpoint, number, &info->request_id.sequence_number)) {
      requester_identify(endpoint, &info->request_id);
      result = rmw_local_take_reply(endpoint, &sample, ros_response);
      rmw_service_describe(&sample, info);
      *taken = result == RMW_RET_OK;
      return result;
    }
    rmw_local_discard_reply(endpoint); /* a second one, or one to a request that newer ones replaced */
  }
  if (requester_report(endpoint)) {
    return RMW_RET_ERROR;
  }
  while (xrce_read_peek(endpoint, &sample)) { /* at most MICROROS_REQUESTS_MAX rounds */
    if (requester_match(endpoint, &sample, &info->request_id)) {
      rmw_service_describe(&sample, info);
      result = rmw_service_decode(endpoint, &sample, XRCE_RELATED_SIZE, ros_response);
      *taken = result == RMW_RET_OK;
      return result;
    }
    xrce_read_pop(endpoint, true);
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_requester_take(
  const rmw_client_t * client, rmw_service_info_t * info, void * ros_response, bool * taken)
{
  rmw_ret_t result;

  microros_lock();
  result = requester_take(client, info, ros_response, taken);
  microros_unlock();
  return result;
}

static rmw_ret_t requester_send_local(
  const xrce_endpoint_t * endpoint, const void * ros_request, int64_t * sequence_number)
{
  const rmw_local_number_t number = {
    xrce_requests_of(endpoint)->sequence + 1, xrce_session_next_request(&endpoint->client->session)};
  const rmw_ret_t result =
    rmw_local_send_request(endpoint, xrce_service_of(endpoint)->sent, &number, ros_request);

  if (result == RMW_RET_OK) {
    *sequence_number = xrce_requests_add(endpoint, number.request);
  }
  return result;
}

static rmw_ret_t requester_send_peer(
  const xrce_endpoint_t * endpoint, const void * ros_request, int64_t * sequence_number)
{
  uint16_t number;
  const rmw_ret_t result =
    rmw_peer_send_request(endpoint, xrce_service_of(endpoint)->sent, ros_request, &number);

  if (result == RMW_RET_OK) {
    *sequence_number = xrce_requests_add(endpoint, number);
  }
  return result;
}

static rmw_ret_t requester_send(
  const rmw_client_t * client, const void * ros_request, int64_t * sequence_number)
{
  cdr_fault_t fault; /* set if the message is refused */
  xrce_endpoint_t * endpoint = client->data;
  xrce_write_t outcome;
  uint16_t request;
  bool is_open;

  if (rmw_local_server(endpoint, &is_open)) {
    return requester_send_local(endpoint, ros_request, sequence_number);
  }
  if (rmw_peer_server(endpoint, &is_open)) {
    return requester_send_peer(endpoint, ros_request, sequence_number);
  }
  request = xrce_session_next_request(&endpoint->client->session);
  outcome = xrce_service_write(endpoint, request, NULL, ros_request, &fault);
  if (outcome == XRCE_WRITTEN) {
    *sequence_number = xrce_requests_add(endpoint, request);
  }
  return rmw_service_report(endpoint, outcome, &fault);
}

rmw_ret_t rmw_requester_send(const rmw_client_t * client, const void * ros_request, int64_t * sequence_number)
{
  rmw_ret_t result;

  microros_lock();
  result = requester_send(client, ros_request, sequence_number);
  microros_unlock();
  return result;
}

rmw_ret_t rmw_uros_get_client_statistics(
  const rmw_client_t * client, rmw_uros_client_statistics_t * statistics)
{
  const xrce_requester_t * requester;
  xrce_read_counters_t counted;

  if (!rmw_requester_is_open(client) || statistics == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "client or statistics");
  }
  microros_lock();
  counted = xrce_read_counters(client->data);
  statistics->dropped = counted.dropped;
  statistics->refused = counted.refused;
  requester = xrce_requests_of(client->data);
  statistics->given_up = requester->given_up;
  statistics->interrupted = requester->interrupted;
  microros_unlock();
  return RMW_RET_OK;
}
