/* SPDX-License-Identifier: Apache-2.0 */
/* Links over network interfaces that can disappear and return, as a USB adapter does. Internal. */
#ifndef MICROROS_XRCE_PEER_FIND_H
#define MICROROS_XRCE_PEER_FIND_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_peer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How often an interface is looked for, milliseconds. */
#define XRCE_PEER_FIND_MS 250u

/*
 * Called at each step after a link has received. Opens it again if its interface is gone, or if the other board has not
 * answered yet: the system selects the own address when a link is opened, and the right interface may appear later.
 * Returns whether the interface is gone: nothing could be sent for XRCE_PEER_FIND_MS. */
bool xrce_peer_find(xrce_client_t * client, uint8_t index, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_FIND_H */
