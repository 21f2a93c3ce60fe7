/* SPDX-License-Identifier: Apache-2.0 */
/* `nodes:` is in the application file: only the publishers that it declares can be opened; the names are constants. */
#include "microros/error.h"
#include "microros/plan.h"
#include "microros/rmw_node.h"
#include "microros/rmw_publisher.h"
#include "microros/xrce_client.h"

#include <string.h>

uint16_t rmw_publisher_take(
  xrce_client_t * client, uint16_t node, const rmw_name_t * topic, const char * given,
  const microros_message_type_t * type)
{
  microros_error_t error = MICROROS_ERROR_PUBLISHER_UNDECLARED;

  for (uint16_t i = 0; i < MICROROS_PUBLISHERS_MAX; ++i) {
    const microros_declared_publisher_t * declared = &microros_declared_publishers[i];

    if (
      declared->node != node || !rmw_name_equals(topic, declared->topic) ||
      strcmp(declared->dds_type, type->dds_type_name) != 0) {
      continue;
    }
    if (!client->writers[i].state.wanted) {
      client->writers[i].topic = declared->topic;
      return i;
    }
    error = MICROROS_ERROR_PUBLISHER_OPEN;
  }
  microros_error_set(error, given, type->dds_type_name, 0, 0);
  return RMW_NO_PLACE;
}
