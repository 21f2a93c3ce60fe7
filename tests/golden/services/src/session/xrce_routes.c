/* SPDX-License-Identifier: Apache-2.0 */
/* Contributions of the selected components to the session, from their component.yaml. */
#include "microros/xrce_routes.h"

#include "microros/xrce_client.h"
#include "microros/xrce_entities_hooks.h"
#include "microros/xrce_ping_hooks.h"
#include "microros/xrce_read_hooks.h"
#include "microros/xrce_services_hooks.h"
#include "microros/xrce_session_close.h"
#include "microros/xrce_stream_best_effort.h"
#include "microros/xrce_stream_reliable_hooks.h"
#include "microros/xrce_stream_reliable_input_hooks.h"
#include "microros/xrce_wire.h"

bool xrce_route_message(xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now)
{
  if (xrce_stream_reliable_input_owns(message)) {
    return xrce_stream_reliable_input_take(client, message, size, now);
  }
  if (!xrce_session_take_submessages(client, message, size, now)) {
    return false;
  }
  return true;
}

void xrce_route_submessage(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  switch (submessage[0]) {
    case XRCE_STATUS_AGENT:
      xrce_session_on_status_agent(client, submessage, size, now);
      break;
    case XRCE_STATUS:
      xrce_session_leave_on_status(client, submessage, size, now);
      xrce_entities_on_status(client, submessage, size, now);
      xrce_read_on_status(client, submessage, size, now);
      break;
    case XRCE_INFO:
      xrce_ping_on_info(client, submessage, size, now);
      break;
    case XRCE_DATA:
      xrce_read_on_data(client, submessage, size, now);
      break;
    case XRCE_ACKNACK:
      xrce_stream_reliable_take_acknack(client, submessage, size, now);
      xrce_read_on_acknack(client, submessage, size, now);
      break;
    case XRCE_HEARTBEAT:
      xrce_stream_reliable_input_take_heartbeat(client, submessage, size, now);
      break;
    case XRCE_FRAGMENT:
      xrce_fragments_on_fragment(client, submessage, size, now);
      break;
    default:
      break;
  }
}

void xrce_route_step(xrce_client_t * client, uint32_t now)
{
  xrce_ping_step(client, now);
  xrce_session_step(client, now);
  xrce_entities_step(client, now);
  xrce_read_step(client, now);
  xrce_stream_reliable_step(&client->reliable, &client->session, xrce_route_settled(client), now);
}

void xrce_route_connected(xrce_client_t * client, uint32_t now)
{
  xrce_stream_best_effort_reset();
  xrce_stream_reliable_hold(&client->reliable, now);
  xrce_stream_reliable_input_reset(&client->reliable_input);
  xrce_fragments_reset(&client->fragments);
  xrce_entities_renew(client);
  xrce_read_renew(client);
  xrce_requests_renew(client);
  xrce_ping_reset(&client->ping);
}

void xrce_route_close(xrce_client_t * client)
{
  xrce_session_leave(client, client->close_timeout_ms);
  xrce_session_close(client);
}

uint8_t * xrce_route_reserve(xrce_client_t * client, bool reliable)
{
  if (xrce_services_keep_back(client, reliable)) {
    return NULL;
  }
  return reliable ? xrce_stream_reliable_reserve(&client->reliable, &client->session)
                  : xrce_stream_best_effort_reserve();
}

bool xrce_route_commit(xrce_client_t * client, bool reliable, size_t size)
{
  return reliable ? xrce_stream_reliable_put(client, size)
                  : xrce_stream_best_effort_commit(&client->session, size);
}

size_t xrce_route_capacity(bool reliable)
{
  return reliable ? MICROROS_RELIABLE_SLOT_SIZE - MICROROS_RELIABLE_FRONT - XRCE_WRITE_PREFIX
                  : MICROROS_BEST_EFFORT_SIZE - XRCE_MESSAGE_HEADER - XRCE_WRITE_PREFIX;
}

const uint8_t * xrce_route_drop_oldest(xrce_client_t * client)
{
  const uint8_t * dropped;

  dropped = xrce_stream_reliable_drop_oldest(&client->reliable, &client->session, client->session.now_ms);
  return dropped;
}

uint16_t xrce_route_unacknowledged(const xrce_client_t * client)
{
  return client->reliable.count;
}

bool xrce_route_has_passed(const xrce_client_t * client, xrce_mark_t * mark)
{
  return xrce_stream_reliable_has_passed(&client->reliable, &client->session, mark);
}

bool xrce_route_settled(const xrce_client_t * client)
{
  return xrce_entities_settled(client);
}
