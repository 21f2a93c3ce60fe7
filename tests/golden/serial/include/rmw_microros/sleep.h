/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sleep cycles: an addition of this client to rmw_microros. The session survives a deep sleep in retained
 * memory; afterwards the application starts as usual, and nothing is connected or created again:
 *
 *     static rmw_uros_retained_t retained;     in a section that start-up code does not initialize
 *
 *     rmw_uros_wake(&retained);                before rclc_support_init; false after a cold start
 *     ... init calls as usual, publish, spin ...
 *     rmw_uros_sleep(rcl_context_get_rmw_context(&support.context), &retained, 200);
 *     ... the device sleeps, its other memory is lost ...
 */
#ifndef MICROROS_RMW_MICROROS_SLEEP_H
#define MICROROS_RMW_MICROROS_SLEEP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_client.h"
#include "microros/xrce_stream_reliable_slots.h"
#include "rmw/init.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { RMW_UROS_RETAINED_PLAN = sizeof(MICROROS_PLAN_ID) };

/* The session while the device sleeps; its size depends on the plan. The application chooses its memory
 * and treats it as opaque. It can also be copied to non-volatile memory and back. */
typedef struct rmw_uros_retained_t {
  uint32_t magic;
  uint32_t check; /* CRC-32 of all following members */
  uint32_t size;
  char plan[RMW_UROS_RETAINED_PLAN];
  uint8_t client[sizeof(struct xrce_client_t)];
  xrce_reliable_slots_t xrce_reliable_slots;
} rmw_uros_retained_t;

/*
 * Puts the session to sleep: waits for at most `timeout_ms` until entities in creation exist, writes
 * *retained, closes the transport and the context, and sends nothing to the agent. Unacknowledged messages
 * and samples that were not taken are preserved. RMW_RET_TIMEOUT: no session, or not all entities exist;
 * everything continues as before, and a sleep now ends in a new session. RMW_RET_INVALID_ARGUMENT: no open
 * context, or NULL.
 */
rmw_ret_t rmw_uros_sleep(rmw_context_t * context, rmw_uros_retained_t * retained, uint32_t timeout_ms);

/*
 * Call this before rcl_init. True: the next rcl_init resumes the session at once, unless it has another
 * client key; entities opened with the same names and types are available at once, with everything that
 * has arrived for them. Entities that are not opened again stay at the agent until the session ends.
 * False: a cold start, invalid contents, or those of an application that was built differently; then
 * rcl_init opens a session as usual. *retained is good for one wake-up.
 *
 * If the agent has dropped the session meanwhile, the client detects it as without sleep (`liveliness`;
 * with `ping` it asks at once) and opens a new one by itself. Time synchronization and callbacks do not
 * survive the sleep.
 */
bool rmw_uros_wake(rmw_uros_retained_t * retained);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_SLEEP_H */
