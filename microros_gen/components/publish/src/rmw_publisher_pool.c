/* SPDX-License-Identifier: Apache-2.0 */
/* No `nodes:` in the application file: any publisher takes one of the places of `pools: {publishers: N}`. */
#include "microros/error.h"
#include "microros/rmw_node.h"
#include "microros/rmw_publisher.h"
#include "microros/xrce_client.h"

uint16_t rmw_publisher_take(
  xrce_client_t * client, uint16_t node, const rmw_name_t * topic, const char * given,
  const microros_message_type_t * type)
{
  static char topics[MICROROS_PUBLISHERS_MAX][MICROROS_NAME_SIZE];
  const size_t size = rmw_name_size(topic);

  (void)node;
  (void)type;
  if (size >= MICROROS_NAME_SIZE) {
    microros_error_set(MICROROS_ERROR_NAME_LONG, given, NULL, (uint32_t)size, (uint32_t)size + 1u);
    return RMW_NO_PLACE;
  }
  for (uint16_t i = 0; i < MICROROS_PUBLISHERS_MAX; ++i) {
    if (!client->writers[i].state.wanted) {
      rmw_name_copy(topic, topics[i]);
      client->writers[i].topic = topics[i];
      return i;
    }
  }
  microros_error_set(
    MICROROS_ERROR_PUBLISHERS_FULL, given, NULL, MICROROS_PUBLISHERS_MAX, MICROROS_PUBLISHERS_MAX + 1u);
  return RMW_NO_PLACE;
}
