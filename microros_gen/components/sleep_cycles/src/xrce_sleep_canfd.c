/* SPDX-License-Identifier: Apache-2.0 */
/* transport: canfd. The identifier of the frames identifies this client to the agent. */
#include "microros/xrce_sleep.h"

bool xrce_sleep_open(xrce_transport_t * transport, uint16_t local)
{
  (void)local;
  return xrce_transport_open(transport);
}

uint16_t xrce_sleep_local(const xrce_transport_t * transport)
{
  (void)transport;
  return 0;
}
