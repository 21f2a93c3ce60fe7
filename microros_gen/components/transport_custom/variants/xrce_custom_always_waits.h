/* SPDX-License-Identifier: Apache-2.0 */
/* Reading waits a millisecond. */
#ifndef MICROROS_XRCE_CUSTOM_READING_H
#define MICROROS_XRCE_CUSTOM_READING_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/port.h"
#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What functions over UDP wait with 0 is for ever, or they look for no packet at all: 1 is the least. */
enum { XRCE_CUSTOM_WAIT_MS = 1 };

/* The read function is going to be called. */
static inline void xrce_custom_note_reading(xrce_transport_t * transport)
{
  transport->read_ms = port_time_ms();
}

/* Whether who sends may leave received messages to others for now: reading waits for them, and was done less than `pause_ms` ago. */
static inline bool xrce_transport_may_skip_reading(const xrce_transport_t * transport, uint32_t pause_ms)
{
  return port_time_ms() - transport->read_ms < pause_ms;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CUSTOM_READING_H */
