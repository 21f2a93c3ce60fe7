/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sleep cycles: an addition of this client to rmw_microros. The session outlives a deep sleep in memory that stays; after
 * it the application starts as ever, and nothing is connected or created again:
 *
 *   static rmw_uros_retained_t retained;     in a section that start-up code leaves alone
 *
 *   rmw_uros_wake(&retained);                before rclc_support_init; false after a cold start
 *   ... init calls as ever, publish, spin ...
 *   rmw_uros_sleep(rcl_context_get_rmw_context(&support.context), &retained, 200);
 *   ... the device sleeps, its other memory is lost ...
 */
#ifndef MICROROS_RMW_MICROROS_SLEEP_H
#define MICROROS_RMW_MICROROS_SLEEP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_client.h"
#include "rmw/init.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { RMW_UROS_RETAINED_PLAN = sizeof(MICROROS_PLAN_ID) };

/* The session while the device sleeps; its size follows from the plan. The application says where it lies and does not
 * look into it. It may as well be copied to a memory that outlives power, and back. */
typedef struct rmw_uros_retained_t {
  uint32_t magic;
  uint32_t check; /* of all that follows */
  uint32_t size;
  char plan[RMW_UROS_RETAINED_PLAN];
  uint8_t client[offsetof(struct xrce_client_t, input)];
} rmw_uros_retained_t;

/*
 * Puts the session to sleep: waits at most `timeout_ms` until entities that are being created are there, writes
 * *retained, closes the transport and the context, and tells the agent nothing. What is unacknowledged or not taken is kept
 * and goes on after the sleep. RMW_RET_TIMEOUT: there is no session, or not all of its entities; everything goes on as it
 * was, and a sleep now ends in a new session. RMW_RET_INVALID_ARGUMENT: no open context, or NULL.
 */
rmw_ret_t rmw_uros_sleep(rmw_context_t * context, rmw_uros_retained_t * retained, uint32_t timeout_ms);

/*
 * To be called before rcl_init. True: the next rcl_init goes on with the session, at once, unless it has another client
 * key; entities that are opened as they were before are there at once, and with what has arrived for them. One that is not
 * opened again stays at the agent until the session ends. False: a cold start, other contents, or those of an application
 * that was built differently; then rcl_init opens a session as ever. *retained is good for one wake-up.
 *
 * Where the agent has forgotten the session meanwhile, the client notices as it does without sleep (`liveliness`; with
 * `ping` it asks at once) and opens a new one by itself. Time synchronization and callbacks do not outlive the sleep.
 */
bool rmw_uros_wake(rmw_uros_retained_t * retained);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_SLEEP_H */
