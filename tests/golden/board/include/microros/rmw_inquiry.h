/* SPDX-License-Identifier: Apache-2.0 */
/* Asks for an agent over a transport that belongs to no session. Internal. */
#ifndef MICROROS_RMW_INQUIRY_H
#define MICROROS_RMW_INQUIRY_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_transport.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Opens a prepared transport, sends up to `attempts` requests, waits `timeout_ms` for each answer, and
 * closes it. Returns whether an answer arrived. The caller holds the lock; it is released while this
 * function waits, unless no session exists, which could then be opened over the same line.
 */
bool rmw_inquiry_run(xrce_transport_t * transport, uint32_t timeout_ms, uint8_t attempts);

/* Single-task variant: no other task can be asking over a line with shared memory. */
static inline void rmw_inquiry_await(void)
{
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_INQUIRY_H */
