/* SPDX-License-Identifier: Apache-2.0 */
/* Repliers and requesters by name: "set_bool__rp" of the service /set_bool, "set_bool__rq" of its client. */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"
#include "microros/xrce_describe_service.h"
#include "microros/xrce_service_sizes.h"

uint8_t * xrce_describe_service(
  const xrce_client_t * client, uint16_t place, uint8_t * blob, uint8_t * format)
{
  const char * name = client->endpoints[place - MICROROS_NODES_MAX].name;
  uint8_t * end = xrce_describe_sized(blob, &name[1], (size_t)xrce_service_sizes_of(client, place).name - 1u);

  *format = XRCE_FORMAT_REFERENCE;
  end = xrce_describe_text(end, place < XRCE_REQUESTERS_AT ? "__rp" : "__rq");
  *end++ = 0;
  return end;
}
