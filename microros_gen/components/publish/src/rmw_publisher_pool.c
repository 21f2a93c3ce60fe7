/* SPDX-License-Identifier: Apache-2.0 */
/* No `nodes:` in the application file: any publisher uses one of `pools: {publishers: N}`. */
#include "microros/error.h"
#include "microros/rmw_publisher.h"
#include "microros/text.h"
#include "microros/xrce_client.h"

bool rmw_publisher_take(xrce_endpoint_t * writer, const rmw_name_t * topic, const char * given)
{
  static char topics[MICROROS_PUBLISHERS_MAX][MICROROS_NAME_SIZE];
  const size_t size = rmw_name_size(topic);

  if (size >= MICROROS_NAME_SIZE) {
    microros_error_set(microros_error_name_long, given, NULL, (uint32_t)size, (uint32_t)size + 1u);
    return false;
  }
  if (microros_text_size(writer->type->dds_type_name) >= MICROROS_TYPE_NAME_SIZE) {
    microros_error_set(
      microros_error_name, writer->type->dds_type_name, "too long for the stream of this plan", 0, 0);
    return false;
  }
  for (uint16_t i = 0; i < MICROROS_PUBLISHERS_MAX; ++i) {
    if (xrce_place_is_free(&writer->client->states[MICROROS_NODES_MAX + i])) {
      rmw_name_copy(topic, topics[i]);
      writer->name = topics[i];
      writer->index = i;
      return true;
    }
  }
  microros_error_set(
    microros_error_of_pool(microros_error_publishers_full, MICROROS_PUBLISHERS_MAX), given, NULL,
    MICROROS_PUBLISHERS_MAX, MICROROS_PUBLISHERS_MAX + 1u);
  return false;
}
