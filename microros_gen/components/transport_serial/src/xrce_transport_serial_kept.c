/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_transport.h"

bool xrce_transport_send_kept(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  if (port_serial_has_kept(&transport->serial)) {
    return false; /* the interrupt owns its frame */
  }
  xrce_frame_begin(&transport->frame, message, (uint16_t)size);
  return port_serial_send_kept(&transport->serial, xrce_frame_next, &transport->frame);
}

void xrce_transport_take_back(xrce_transport_t * transport, const uint8_t * message)
{
  if (transport->frame.message == message) {
    port_serial_break_off(&transport->serial);
  }
}
