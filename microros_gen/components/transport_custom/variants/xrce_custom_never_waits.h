/* SPDX-License-Identifier: Apache-2.0 */
/* Reading never waits. */
#ifndef MICROROS_XRCE_CUSTOM_READING_H
#define MICROROS_XRCE_CUSTOM_READING_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The application says that its function looks and returns: transport: {read_polls: true}. With framing it does, too. */
enum { XRCE_CUSTOM_WAIT_MS = 0 };

/* The read function is going to be called. */
static inline void xrce_custom_note_reading(xrce_transport_t * transport)
{
  (void)transport;
}

/* Whether who sends may leave received messages to others for now: reading never waits. */
static inline bool xrce_transport_may_skip_reading(const xrce_transport_t * transport, uint32_t pause_ms)
{
  (void)transport;
  (void)pause_ms;
  return false;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CUSTOM_READING_H */
