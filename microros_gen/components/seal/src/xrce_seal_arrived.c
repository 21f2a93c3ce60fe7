/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_transport.h"

/* A partial record is in a buffer of the transport, and no byte of it in that of the session. */
uint32_t xrce_transport_arrived(const xrce_transport_t * transport)
{
  (void)transport;
  return 0;
}
