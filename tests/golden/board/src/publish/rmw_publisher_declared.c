/* SPDX-License-Identifier: Apache-2.0 */
/* `nodes:` is in the application file: only declared publishers can be opened; the names are constants. */
#include "microros/error.h"
#include "microros/plan.h"
#include "microros/rmw_publisher.h"
#include "microros/text.h"
#include "microros/xrce_client.h"

bool rmw_publisher_take(xrce_endpoint_t * writer, const rmw_name_t * topic, const char * given)
{
  const MICROROS_FLASH char * type = writer->type->dds_type_name;
  microros_error_t error = microros_error_publisher_undeclared;

  for (uint16_t i = 0; i < MICROROS_PUBLISHERS_MAX; ++i) {
    const MICROROS_FLASH microros_declared_endpoint_t * declared = &microros_declared_endpoints[i];

    if (
      declared->node != writer->participant || !rmw_name_equals(topic, microros_declared_name(declared)) ||
      !microros_text_equals(declared->dds_type, type)) {
      continue;
    }
    if (xrce_place_is_free(&writer->client->states[MICROROS_NODES_MAX + i])) {
      writer->name = declared->name;
      writer->index = i;
      return true;
    }
    error = microros_error_publisher_open;
  }
  microros_error_set(error, given, type, 0, 0);
  return false;
}
