/* SPDX-License-Identifier: Apache-2.0 */
/* Variant: reading waits a millisecond. */
#ifndef MICROROS_XRCE_CUSTOM_READING_H
#define MICROROS_XRCE_CUSTOM_READING_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/port.h"
#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* With 0, functions over UDP may wait without end or never look for a packet: 1 is the minimum. */
enum { XRCE_CUSTOM_WAIT_MS = 1 };

/* Called before the read function. */
static inline void xrce_custom_note_reading(xrce_transport_t * transport)
{
  transport->read_ms = port_time_ms();
}

/*
 * Returns whether a publish may skip reading for now: reading waits, and was last done less than
 * `pause_ms` ago. */
static inline bool xrce_transport_may_skip_reading(const xrce_transport_t * transport, uint32_t pause_ms)
{
  return port_time_ms() - transport->read_ms < pause_ms;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CUSTOM_READING_H */
