/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_declared.h"

#include "microros/plan.h"
#include "microros/text.h"
#include "microros/xrce_client.h"

bool rmw_declared_take(
  xrce_endpoint_t * wanted, uint16_t * at, uint16_t end, const MICROROS_FLASH char * dds_type)
{
  uint16_t i = *at;
  const MICROROS_FLASH microros_declared_endpoint_t * declared = &microros_declared_endpoints[i];

  while (i < end &&
         (declared->node != wanted->participant || !microros_text_equals(declared->dds_type, dds_type))) {
    ++i;
    ++declared;
  }
  if (i >= end) {
    return false;
  }
  wanted->name = declared->name;
  wanted->index = i;
  *at = (uint16_t)(i + 1u);
  return xrce_place_is_free(&wanted->client->states[MICROROS_NODES_MAX + i]);
}
