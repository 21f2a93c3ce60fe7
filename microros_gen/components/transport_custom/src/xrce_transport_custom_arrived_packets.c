/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_transport.h"

uint32_t xrce_transport_arrived(const xrce_transport_t * transport)
{
  (void)transport;
  return 0;
}
