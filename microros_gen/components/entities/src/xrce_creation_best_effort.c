/* SPDX-License-Identifier: Apache-2.0 */
/*
 * creation: best_effort. Each repetition is a separate message; the agent reports that the object already
 * exists. */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"
#include "microros/xrce_stream_best_effort_spare.h"

bool xrce_creation_begin(xrce_client_t * client, uint32_t now)
{
  (void)client;
  (void)now;
  return true;
}

uint8_t * xrce_creation_room(xrce_client_t * client)
{
  (void)client;
  return xrce_stream_best_effort_spare();
}

void xrce_creation_send(xrce_client_t * client, size_t size)
{
  xrce_stream_best_effort_send_spare(&client->session, size);
}

void xrce_creation_end(xrce_client_t * client)
{
  (void)client;
}
