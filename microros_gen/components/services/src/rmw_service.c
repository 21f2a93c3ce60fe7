/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_service.h"

#include "microros/epoch.h"
#include "microros/error.h"
#include "microros/port.h"
#include "microros/rmw_decode.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_qos.h"
#include "microros/rmw_service_start.h"
#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

#define NS_PER_MS 1000000

rmw_ret_t rmw_service_open(
  xrce_endpoint_t * wanted, const xrce_service_t * service, const rmw_section_t * section,
  const rmw_node_t * node, const char * name, const rmw_qos_profile_t * qos)
{
  const rmw_name_t full = rmw_name_of_topic(name, node->name, node->namespace_);
  const char * refused = rmw_qos_to_xrce(qos, &wanted->qos, &wanted->depth);

  if (refused != NULL) {
    microros_error_set(microros_error_service_qos, name, refused, 0, 0);
    return RMW_RET_UNSUPPORTED;
  }
  wanted->qos |= (uint8_t)XRCE_QOS_RELIABLE; /* service objects have no QoS on the wire */
  if (!rmw_receiver_take(wanted, section, &full, name)) {
    return RMW_RET_ERROR;
  }
  return rmw_service_start(wanted, service);
}

rmw_ret_t rmw_service_report(
  const xrce_endpoint_t * endpoint, xrce_write_t outcome, const cdr_fault_t * fault)
{
  uint32_t waiting;

  switch (outcome) {
    case XRCE_WRITTEN:
    case XRCE_WRITE_DROPPED:
      return RMW_RET_OK;
    case XRCE_WRITE_REFUSED:
      return rmw_encode_refuse(xrce_service_of(endpoint)->sent, fault);
    case XRCE_WRITE_FULL:
      waiting = xrce_route_unacknowledged(endpoint->client);
      microros_error_set(microros_error_service_full, endpoint->name, NULL, waiting, waiting + 1u);
      break;
    case XRCE_WRITE_NO_SESSION:
    case XRCE_WRITE_NOT_SENT:
    default:
      microros_error_set(microros_error_service_session, endpoint->name, NULL, 0, 0);
      break;
  }
  return RMW_RET_ERROR;
}

void rmw_service_describe(const xrce_sample_t * sample, rmw_service_info_t * info)
{
  const int64_t age_ns = (int64_t)(port_time_ms() - sample->arrived_ms) * NS_PER_MS;
  const int64_t epoch_ns = microros_epoch_known_ns();

  info->source_timestamp = 0;                                       /* XRCE does not carry it */
  info->received_timestamp = epoch_ns != 0 ? epoch_ns - age_ns : 0; /* the time of day has not been set yet */
}

rmw_ret_t rmw_service_decode(
  const xrce_endpoint_t * endpoint, const xrce_sample_t * sample, uint16_t head, void * message)
{
  const rmw_ret_t result = rmw_decode(
    endpoint->type, &sample->data[head], (uint32_t)sample->size - head, sample->big_endian, message);

  xrce_read_pop(endpoint, result != RMW_RET_OK);
  return result;
}
