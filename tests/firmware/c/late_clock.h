/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The clock of a board, in place of that of the port: its 32 bits wrap four seconds after the start. For an image of whose
 * library each source is an object: the linker then leaves the clock of the port out.
 */
#ifndef LATE_CLOCK_H
#define LATE_CLOCK_H

#include <microros/port.h>

#include <stdint.h>

void port_bare_tick(void);

static volatile uint32_t late_now_ms = UINT32_MAX - 4000u;

void port_bare_tick(void)
{
  late_now_ms = late_now_ms + 1u;
}

uint32_t port_time_ms(void)
{
  return late_now_ms;
}

/* Returns whether it has wrapped. */
static inline uint32_t late_has_wrapped(void)
{
  return late_now_ms < UINT32_MAX / 2u ? 1u : 0u;
}

#endif /* LATE_CLOCK_H */
