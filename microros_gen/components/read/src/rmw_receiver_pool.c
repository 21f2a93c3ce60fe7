/* SPDX-License-Identifier: Apache-2.0 */
/* No `nodes:` in the application file: any receiver uses one of the places of `pools`. */
#include "microros/rmw_receiver.h"
#include "microros/text.h"
#include "microros/xrce_client.h"

#include <stddef.h>

bool rmw_receiver_take(
  xrce_endpoint_t * wanted, const rmw_section_t * section, const rmw_name_t * name, const char * given)
{
  static char names[XRCE_RECEIVERS][MICROROS_NAME_SIZE];
  const size_t size = rmw_name_size(name);
  const uint16_t end = (uint16_t)(section->first + section->count);

  if (size >= MICROROS_NAME_SIZE) {
    microros_error_set(microros_error_name_long, given, NULL, (uint32_t)size, (uint32_t)size + 1u);
    return false;
  }
  if (microros_text_size(section->dds_type_name) >= MICROROS_TYPE_NAME_SIZE) {
    microros_error_set(
      microros_error_name, section->dds_type_name, "too long for the stream of this plan", 0, 0);
    return false;
  }
  for (uint16_t i = section->first; i < end; ++i) {
    if (xrce_place_is_free(&wanted->client->states[MICROROS_NODES_MAX + i])) {
      char * text = names[i - MICROROS_PUBLISHERS_MAX];

      rmw_name_copy(name, text);
      wanted->name = text;
      wanted->index = i;
      return true;
    }
  }
  microros_error_set(section->full, given, NULL, section->count, section->count + 1u);
  return false;
}
