/* SPDX-License-Identifier: Apache-2.0 */
/* Each link has its own identifiers: several of them, and the agent, share one bus. */
#include "microros/xrce_peer.h"

#include <string.h>

bool xrce_peer_open(xrce_transport_t * transport, uint8_t index)
{
  const xrce_peer_frames_t * frames = &xrce_peer_frames[index];

  (void)memset(transport, 0, sizeof(*transport));
  transport->device = xrce_peer_lines[index].remote;
  transport->id = frames->sent;
  return port_can_open_link(&transport->can, transport->device, frames->sent, frames->received);
}
