/* SPDX-License-Identifier: Apache-2.0 */
/* The agent has created the entities when the session starts: nothing is sent for them. */
#include "microros/xrce_client.h"
#include "microros/xrce_entities.h"

void xrce_entities_add(xrce_client_t * client, uint16_t place)
{
  client->states[place].wanted = true;
  client->states[place].level = xrce_place_complete(place);
}

void xrce_entities_remove(xrce_client_t * client, uint16_t place)
{
  client->states[place].wanted = false;
  client->states[place].level = 0;
  for (uint16_t i = 0; i < (uint16_t)XRCE_ENDPOINTS; ++i) {
    if (client->endpoints[i].participant == place) {
      client->states[MICROROS_NODES_MAX + i].wanted = false;
      client->states[MICROROS_NODES_MAX + i].level = 0;
    }
  }
}

uint8_t xrce_entities_await(xrce_client_t * client, uint16_t place, uint32_t timeout_ms)
{
  if (!client->states[place].wanted || xrce_session_await(client, timeout_ms)) {
    return XRCE_DONE;
  }
  return XRCE_SILENT;
}
