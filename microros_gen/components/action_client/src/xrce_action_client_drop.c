/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_action_client_hooks.h"
#include "microros/xrce_services.h"
#include "microros/xrce_wire.h"

void xrce_action_client_drop(xrce_client_t * client, const uint8_t * dropped)
{
  const uint16_t request = xrce_get_be16(&dropped[XRCE_SUBMESSAGE_HEADER]);
  const uint16_t object = xrce_get_be16(&dropped[XRCE_SUBMESSAGE_HEADER + 2]);
  const uint16_t index = xrce_object_index(object);

  if (object == xrce_object_id(index, (uint8_t)XRCE_KIND_REQUESTER)) {
    int64_t sequence;

    (void)xrce_requests_take(&client->endpoints[index], request, &sequence);
    ++client->action_client_drops;
  }
}
