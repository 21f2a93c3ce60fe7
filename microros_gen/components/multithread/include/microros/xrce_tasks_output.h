/* SPDX-License-Identifier: Apache-2.0 */
/* Hook called by the reliable output stream if both are selected. Internal. */
#ifndef MICROROS_XRCE_TASKS_OUTPUT_H
#define MICROROS_XRCE_TASKS_OUTPUT_H

#include "microros/port.h"
#include "microros/wake.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A message is about to be stored: waiting tasks must learn that a HEARTBEAT may be due, unless another one sends the message.
 * It counts as news: the wait that the wake-up ends may be that of a task which does not wait again. */
static inline void xrce_tasks_commit(const xrce_client_t * client, bool reliable)
{
  if (reliable && xrce_turn_is_mine() && xrce_stream_reliable_is_idle(&client->reliable)) {
    microros_note();
    if (client->waiting != 0u) {
      port_wake();
    }
  }
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TASKS_OUTPUT_H */
