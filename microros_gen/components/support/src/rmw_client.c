/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_mark.h"
#include "microros/xrce_rest.h"
#include "microros/xrce_routes.h"

const char * const rmw_implementation_identifier = "rmw_microros_gen";

static xrce_client_t instance;

xrce_client_t * rmw_client_instance(void)
{
  return &instance;
}

uint32_t rmw_client_key(void)
{
  uint32_t result;

  microros_lock();
  result = instance.session.key;
  microros_unlock();
  return result;
}

uint32_t rmw_client_reconnects(void)
{
  uint32_t result;

  microros_lock();
  result = instance.session.statistics.reconnects;
  microros_unlock();
  return result;
}

/* Best-effort messages go through the queue, then to the transport, then over its line, in order. */
static bool client_has_sent(xrce_session_t * session, xrce_mark_t * mark)
{
  if (!mark->is_handed) {
    const bool has_passed = xrce_output_queue_has_passed(mark);

    mark->is_handed = has_passed && xrce_turn_is_sent();
  }
  if (mark->is_handed && !mark->is_sent) {
    mark->is_sent = xrce_transport_is_idle(&session->transport);
  }
  return mark->is_sent || !session->transport_open;
}

/* Returns whether all is acknowledged or sent that was stored at the first call. */
static bool client_has_passed(xrce_client_t * client, xrce_mark_t * mark)
{
  const bool is_sent = client_has_sent(&client->session, mark);

  return xrce_route_has_passed(client, mark) && is_sent;
}

bool rmw_client_flush(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();
  xrce_mark_t mark = xrce_mark_new();
  bool flushed;

  microros_lock();
  (void)client_has_passed(client, &mark);
  for (;;) {
    xrce_session_pump(client);
    flushed = client_has_passed(client, &mark);
    if (flushed || port_time_ms() - start >= timeout_ms) {
      break;
    }
    xrce_rest(client);
  }
  microros_unlock();
  return flushed;
}
