/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a diagnosis asks of the platform. Each group is a capability; where a platform has none of the optional ones,
 * the diagnosis leaves them out. Called in the task that pumps the session.
 */
#ifndef MICROROS_PORT_DIAGNOSIS_H
#define MICROROS_PORT_DIAGNOSIS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* `microseconds`: returns microseconds since an arbitrary start; wraps to 0 after 2^32 - 1. Two tasks never call it at
 * the same time. */
uint32_t port_time_us(void);

/* `stack_peak`, optional: return the high-water mark of the stack since the reset, and its size: bytes, at most 40 MB, the
 * size never 0. */
uint32_t port_stack_peak(void);
uint32_t port_stack_size(void);

/* Why the device has restarted. */
typedef enum port_reset_t {
  PORT_RESET_UNKNOWN,
  PORT_RESET_POWER,    /* the supply was turned on */
  PORT_RESET_PIN,      /* the reset pin */
  PORT_RESET_SOFTWARE, /* the program */
  PORT_RESET_WATCHDOG,
  PORT_RESET_BROWN_OUT, /* the supply voltage was too low */
  PORT_RESET_FAULT      /* an exception of the processor */
} port_reset_t;

/* `reset_cause`, optional: returns it; the same value in each call until the next reset. */
port_reset_t port_reset_cause(void);

/* `supply_voltage`, optional: returns the supply voltage, millivolts. Does not block. */
uint32_t port_supply_mv(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_DIAGNOSIS_H */
