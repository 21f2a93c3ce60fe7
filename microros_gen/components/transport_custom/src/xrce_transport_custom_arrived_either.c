/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_transport.h"

uint32_t xrce_transport_arrived(const xrce_transport_t * transport)
{
  return transport->custom.framing ? xrce_framing_arrived(&transport->framing) : 0u;
}
