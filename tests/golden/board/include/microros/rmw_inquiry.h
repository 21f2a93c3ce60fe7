/* SPDX-License-Identifier: Apache-2.0 */
/* Is an agent at the other end of a transport that is no session's? Internal. */
#ifndef MICROROS_RMW_INQUIRY_H
#define MICROROS_RMW_INQUIRY_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_transport.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Opens a prepared transport, asks `attempts` times, waits `timeout_ms` for each answer, and closes it. Returns whether one
 * came. The caller has the lock; it is given back where this waits, unless the line may become that of a session
 * meanwhile: before there is one.
 */
bool rmw_inquiry_ask(xrce_transport_t * transport, uint32_t timeout_ms, uint8_t attempts);

/* No two tasks ask over lines that they would share memory for. */
static inline void rmw_inquiry_await(void)
{
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_INQUIRY_H */
