/* SPDX-License-Identifier: Apache-2.0 */
/* Hook called by the reliable output stream if both are selected. Internal. */
#ifndef MICROROS_XRCE_TASKS_OUTPUT_H
#define MICROROS_XRCE_TASKS_OUTPUT_H

#include "microros/port.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A message is about to be stored: a waiting task must learn that a HEARTBEAT may be due, unless it sends the message. */
static inline void xrce_tasks_commit(const xrce_client_t * client, bool reliable)
{
  if (
    reliable && xrce_turn_is_mine() && client->waiting != 0u &&
    xrce_stream_reliable_is_idle(&client->reliable)) {
    port_wake();
  }
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TASKS_OUTPUT_H */
