/* SPDX-License-Identifier: Apache-2.0 */
/* `nodes:` is in the application file: only declared entities can be opened; the names are constants. */
#include "microros/plan.h"
#include "microros/rmw_receiver.h"
#include "microros/text.h"
#include "microros/xrce_client.h"

bool rmw_receiver_take(
  xrce_endpoint_t * wanted, const rmw_section_t * section, const rmw_name_t * name, const char * given)
{
  const char * type = section->dds_type_name;
  const uint16_t end = (uint16_t)(section->first + section->count);
  microros_error_t error = section->undeclared;

  for (uint16_t i = section->first; i < end; ++i) {
    const microros_declared_endpoint_t * declared = &microros_declared_endpoints[i];

    if (
      declared->node != wanted->participant || !rmw_name_equals(name, microros_declared_name(declared)) ||
      !microros_text_equals(declared->dds_type, type)) {
      continue;
    }
    if (xrce_place_is_free(&wanted->client->states[MICROROS_NODES_MAX + i])) {
      wanted->name = declared->name;
      wanted->index = i;
      return true;
    }
    error = section->taken;
  }
  microros_error_set(error, given, type, 0, 0);
  return false;
}
