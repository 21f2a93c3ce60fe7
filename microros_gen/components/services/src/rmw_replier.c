/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Service servers. The identity of a request stays with the application until it replies; the library
 * stores nothing. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_client.h"
#include "microros/rmw_local_service.h"
#include "microros/rmw_node.h"
#include "microros/rmw_peer_service.h"
#include "microros/rmw_replier_places.h"
#include "microros/rmw_service.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"
#include "rmw_microros/service.h"

#include <stddef.h>
#include <string.h>

/* In SampleIdentity (OMG DDS-XRCE 1.0, annex A): the writer's GUID, then the two halves of the sequence number. */
enum { HIGH_AT = RMW_GID_STORAGE_SIZE, LOW_AT = HIGH_AT + 4 };

static uint32_t replier_get_u32(const uint8_t * at, bool big_endian)
{
  const uint8_t flags = big_endian ? (uint8_t)0 : (uint8_t)XRCE_FLAG_LITTLE_ENDIAN;
  const uint32_t first = xrce_get_u16(&at[0], flags);
  const uint32_t second = xrce_get_u16(&at[2], flags);

  return big_endian ? first << 16 | second : second << 16 | first;
}

static int64_t replier_sequence(const xrce_sample_t * sample)
{
  const uint64_t high = replier_get_u32(&sample->data[HIGH_AT], sample->big_endian);
  const uint64_t low = replier_get_u32(&sample->data[LOW_AT], sample->big_endian);
  const uint64_t sequence = high << 32 | low;

  return (int64_t)sequence;
}

static void replier_put_u32(uint8_t * at, uint32_t value)
{
  xrce_put_le16(&at[0], (uint16_t)(value & UINT16_MAX));
  xrce_put_le16(&at[2], (uint16_t)(value >> 16));
}

rmw_service_t rmw_repliers[MICROROS_SERVICES_MAX]; /* indexed by place */

static rmw_ret_t replier_open(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, const char * name,
  const rmw_qos_profile_t * qos, rmw_service_t ** service)
{
  const microros_service_type_t * type = type_support->data;
  const xrce_service_t opened = {type, type->response};
  const rmw_section_t section = {
    XRCE_REPLIERS_AT - MICROROS_NODES_MAX,
    MICROROS_SERVICES_MAX,
    microros_error_service_undeclared,
    microros_error_service_open,
    microros_error_of_pool(microros_error_services_full, MICROROS_SERVICES_MAX),
    type->dds_type_name};
  xrce_endpoint_t wanted = {
    .client = node->context->impl, .type = type->request, .participant = rmw_node_index(node)};
  const rmw_ret_t result = rmw_service_open(&wanted, &opened, &section, node, name, qos);

  if (result == RMW_RET_OK) {
    *service = rmw_replier_prepare(&wanted.client->endpoints[wanted.index]);
  }
  return result;
}

rmw_ret_t rmw_replier_open(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, const char * name,
  const rmw_qos_profile_t * qos, rmw_service_t ** service)
{
  rmw_ret_t result;

  microros_lock();
  result = replier_open(node, type_support, name, qos, service);
  microros_unlock();
  return result;
}

void rmw_replier_close(rmw_service_t * service)
{
  rmw_receiver_close(service->data);
}

bool rmw_replier_is_open(const rmw_service_t * service)
{
  if (service == NULL || service->data == NULL) {
    return false;
  }
  return rmw_receiver_is_open(service->data);
}

/* Returns whether the reply to the oldest request has room now. */
static bool replier_has_room(const xrce_endpoint_t * endpoint)
{
  bool has_room;

  return rmw_peer_has_room(endpoint, &has_room) ? has_room : xrce_write_reserve(endpoint) != NULL;
}

static bool replier_is_ready(const rmw_service_t * service)
{
  return rmw_local_waits(service->data) ||
         (xrce_read_is_ready(service->data) && replier_has_room(service->data));
}

bool rmw_replier_is_ready(const rmw_service_t * service)
{
  bool result;

  microros_lock();
  result = replier_is_ready(service);
  microros_unlock();
  return result;
}

void rmw_replier_pump(const rmw_service_t * service)
{
  const xrce_endpoint_t * endpoint = service->data;

  microros_lock();
  xrce_session_pump(endpoint->client);
  microros_unlock();
}

/* Gives the sample as well, without its bytes. */
static rmw_ret_t replier_take(
  const rmw_service_t * service, rmw_request_id_t * request, xrce_sample_t * sample, void * ros_request,
  bool * taken)
{
  const xrce_endpoint_t * endpoint = service->data;
  rmw_ret_t result;

  *taken = false;
  if (rmw_local_take_request(endpoint, request, sample, ros_request, &result)) {
    *taken = result == RMW_RET_OK;
    return result;
  }
  if (rmw_receiver_report(endpoint)) {
    return RMW_RET_ERROR;
  }
  if (!replier_has_room(endpoint) || !xrce_read_peek(endpoint, sample)) {
    return RMW_RET_OK; /* a request that cannot be answered yet waits */
  }
  if (sample->size < XRCE_IDENTITY_SIZE) {
    xrce_read_pop(endpoint, true);
    microros_error_set(microros_error_service_short, endpoint->name, NULL, sample->size, XRCE_IDENTITY_SIZE);
    return RMW_RET_ERROR;
  }
  /* at most RMW_GID_STORAGE_SIZE bytes */
  (void)memcpy(request->writer_guid, sample->data, RMW_GID_STORAGE_SIZE);
  request->sequence_number = replier_sequence(sample);
  result = rmw_service_decode(endpoint, sample, XRCE_IDENTITY_SIZE, ros_request);
  *taken = result == RMW_RET_OK;
  return result;
}

rmw_ret_t rmw_replier_take(
  const rmw_service_t * service, rmw_service_info_t * info, void * ros_request, bool * taken)
{
  xrce_sample_t sample;
  rmw_ret_t result;

  microros_lock();
  result = replier_take(service, &info->request_id, &sample, ros_request, taken);
  if (*taken) {
    rmw_service_describe(&sample, info);
  }
  microros_unlock();
  return result;
}

rmw_ret_t rmw_replier_begin(
  const rmw_service_t * service, rmw_request_id_t * request, void * ros_request, bool * taken)
{
  const xrce_endpoint_t * endpoint = service->data;
  xrce_sample_t sample;
  rmw_ret_t result;

  microros_lock();
  result = replier_take(service, request, &sample, ros_request, taken);
  if (*taken && !rmw_peer_keep_room(request)) {
    ++endpoint->client->replies_due;
  }
  microros_unlock();
  return result;
}

static rmw_ret_t replier_respond(
  const rmw_service_t * service, const rmw_request_id_t * request, const void * ros_response)
{
  const uint64_t sequence = (uint64_t)request->sequence_number;
  cdr_fault_t fault; /* set if the message is refused */
  xrce_endpoint_t * endpoint = service->data;
  uint8_t identity[XRCE_IDENTITY_SIZE];
  xrce_write_t outcome;

  if (rmw_local_is_request(request)) {
    return rmw_local_respond(endpoint, xrce_service_of(endpoint)->sent, request, ros_response);
  }
  /* at most RMW_GID_STORAGE_SIZE bytes */
  (void)memcpy(identity, request->writer_guid, RMW_GID_STORAGE_SIZE);
  replier_put_u32(&identity[HIGH_AT], (uint32_t)(sequence >> 32));
  replier_put_u32(&identity[LOW_AT], (uint32_t)(sequence & UINT32_MAX));
  if (rmw_peer_is_request(request)) {
    return rmw_peer_respond(endpoint, xrce_service_of(endpoint)->sent, identity, ros_response);
  }
  outcome = xrce_service_write(endpoint, XRCE_REQUEST_NONE, identity, ros_response, &fault);
  return rmw_service_report(endpoint, outcome, &fault);
}

rmw_ret_t rmw_replier_respond(
  const rmw_service_t * service, const rmw_request_id_t * request, const void * ros_response)
{
  rmw_ret_t result;

  microros_lock();
  result = replier_respond(service, request, ros_response);
  microros_unlock();
  return result;
}

/* A session opened meanwhile has no reserved slot. */
static void replier_release(xrce_client_t * client)
{
  if (client->replies_due != 0u) {
    --client->replies_due;
  }
}

rmw_ret_t rmw_replier_end(
  const rmw_service_t * service, const rmw_request_id_t * request, const void * ros_response)
{
  const xrce_endpoint_t * endpoint = service->data;
  rmw_ret_t result;

  microros_lock();
  if (!rmw_peer_free_room(request)) {
    replier_release(endpoint->client);
  }
  result = replier_respond(service, request, ros_response);
  microros_unlock();
  return result;
}

void rmw_replier_abandon(void)
{
  microros_lock();
  replier_release(rmw_client_instance());
  microros_unlock();
}

rmw_ret_t rmw_uros_get_service_statistics(
  const rmw_service_t * service, rmw_uros_service_statistics_t * statistics)
{
  xrce_read_counters_t counted;

  if (!rmw_replier_is_open(service) || statistics == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "service or statistics");
  }
  microros_lock();
  counted = xrce_read_counters(service->data);
  statistics->dropped = counted.dropped;
  statistics->refused = counted.refused;
  microros_unlock();
  return RMW_RET_OK;
}
