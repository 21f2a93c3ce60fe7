/* SPDX-License-Identifier: Apache-2.0 */
/* Deadlines, for events of rcl; internal. */
#ifndef MICROROS_RMW_DEADLINES_H
#define MICROROS_RMW_DEADLINES_H

#include <stdint.h>

#include "microros/xrce_deadlines.h"

#ifdef __cplusplus
extern "C" {
#endif

/* `endpoint` is the data of an open handle of rmw; NULL: it is observed already. */
xrce_deadline_t * rmw_deadline_open(const void * endpoint);

/* Ends observing; at once, also for a finalized entity. */
void rmw_deadline_close(xrce_deadline_t * deadline);

/* Returns the number of missed deadlines, and in *change those since the last call. */
uint32_t rmw_deadline_take(xrce_deadline_t * deadline, uint32_t * change);

void rmw_deadline_notify(xrce_deadline_t * deadline, rmw_event_callback_t callback, const void * user_data);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_DEADLINES_H */
