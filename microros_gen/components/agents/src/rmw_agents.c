/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/agents.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/xrce_client.h"

#include <stddef.h>

rmw_ret_t rmw_uros_get_agent(const rmw_context_t * context, rmw_uros_agent_t * agent)
{
  const xrce_client_t * client;

  if (context == NULL || context->impl == NULL || agent == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "context or agent");
  }
  client = context->impl;
  microros_lock();
  agent->host = xrce_transport_name(&client->session.transport);
  agent->port = xrce_transport_port(&client->session.transport);
  agent->index =
    client->agents.state == (uint8_t)XRCE_AGENTS_OTHER ? (uint8_t)MICROROS_AGENTS : client->agents.index;
  agent->changes = client->agents.changes;
  microros_unlock();
  return RMW_RET_OK;
}
