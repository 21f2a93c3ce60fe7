/* SPDX-License-Identifier: Apache-2.0 */
/*
 * CREATE_CLIENT asks the agent to drop this client after MICROROS_HARD_LIVELINESS_MS without a message
 * (property uxr_hl, known to agents of Micro XRCE-DDS), together with its entities in ROS 2. To prevent
 * that, the client sends GET_INFO, which every agent answers, when it sent nothing for a third of that
 * time. GET_INFO also answers an agent that asks.
 */
#ifndef MICROROS_XRCE_LIVELINESS_HARD_H
#define MICROROS_XRCE_LIVELINESS_HARD_H

#include <stdint.h>

#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Zero-initialized: valid for a session that has just started. */
typedef struct xrce_liveliness_hard_t {
  uint32_t due_ms; /* when to send GET_INFO unless another message is sent before */
  uint32_t sent;   /* messages sent until then */
} xrce_liveliness_hard_t;

/* Sends GET_INFO when it is due. */
void xrce_liveliness_hard_step(xrce_client_t * client, uint32_t now);

/* The agent asks for a sign of life: the next step answers. */
void xrce_liveliness_hard_on_get_info(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_LIVELINESS_HARD_H */
