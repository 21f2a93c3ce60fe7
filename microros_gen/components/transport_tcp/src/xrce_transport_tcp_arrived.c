/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_transport.h"

uint32_t xrce_transport_arrived(const xrce_transport_t * transport)
{
  return transport->length_arrived == XRCE_TCP_PREFIX ? (uint32_t)transport->arrived : 0u;
}
