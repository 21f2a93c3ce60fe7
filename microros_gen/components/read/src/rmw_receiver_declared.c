/* SPDX-License-Identifier: Apache-2.0 */
/* `nodes:` is in the application file: only declared entities can be opened; the names are constants. */
#include "microros/plan.h"
#include "microros/rmw_receiver.h"
#include "microros/text.h"
#include "microros/xrce_client.h"

/*
 * Looks for a free endpoint that is declared like the wanted one. Without one, looks for an open one, which is another
 * error. Names are compared late: they are long, and begin alike. */
bool rmw_receiver_take(
  xrce_endpoint_t * wanted, const rmw_section_t * section, const rmw_name_t * name, const char * given)
{
  const xrce_object_state_t * states = &wanted->client->states[MICROROS_NODES_MAX];
  const uint32_t end = (uint32_t)section->first + section->count;
  const MICROROS_FLASH microros_declared_endpoint_t * declared;
  bool is_free = false;
  uint32_t i;

  do {
    is_free = !is_free;
    i = section->first;
    declared = &microros_declared_endpoints[i];
    while (i != end && (declared->node != wanted->participant || xrce_place_is_free(&states[i]) != is_free ||
                        !rmw_name_equals(name, microros_declared_name(declared)) ||
                        !microros_text_equals(declared->dds_type, section->dds_type_name))) {
      ++i;
      ++declared;
    }
  } while (i == end && is_free);
  if (is_free) {
    wanted->name = declared->name;
    wanted->index = (uint16_t)i;
  } else {
    microros_error_set(i != end ? section->taken : section->undeclared, given, section->dds_type_name, 0, 0);
  }
  return is_free;
}
