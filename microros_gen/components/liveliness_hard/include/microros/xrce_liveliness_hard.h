/* SPDX-License-Identifier: Apache-2.0 */
/*
 * CREATE_CLIENT asks the agent to give this client up after MICROROS_HARD_LIVELINESS_MS without a message of it (a
 * property, uxr_hl, that agents of Micro XRCE-DDS know), and with it the entities that others in ROS 2 see. So something is
 * sent when a third of that time went by without: GET_INFO, which every agent answers. It is also the answer to an agent
 * that asks.
 */
#ifndef MICROROS_XRCE_LIVELINESS_HARD_H
#define MICROROS_XRCE_LIVELINESS_HARD_H

#include <stdint.h>

#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All zero is right in a session that has just begun. */
typedef struct xrce_liveliness_hard_t {
  uint32_t due_ms; /* when to show life, if nothing is sent before */
  uint32_t sent;   /* messages until then */
} xrce_liveliness_hard_t;

/* Shows life when that is due. */
void xrce_liveliness_hard_step(xrce_client_t * client, uint32_t now);

/* The agent asks: the next step answers. */
void xrce_liveliness_hard_on_get_info(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_LIVELINESS_HARD_H */
