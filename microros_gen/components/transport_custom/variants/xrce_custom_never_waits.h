/* SPDX-License-Identifier: Apache-2.0 */
/* Variant: reading never waits. */
#ifndef MICROROS_XRCE_CUSTOM_READING_H
#define MICROROS_XRCE_CUSTOM_READING_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * The application declares that its function only polls (transport: {read_polls: true}), or framing is
 * used. */
enum { XRCE_CUSTOM_WAIT_MS = 0 };

/* Called before the read function. */
static inline void xrce_custom_note_reading(xrce_transport_t * transport)
{
  (void)transport;
}

/* Returns whether a publish may skip reading for now: no, reading never waits. */
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
