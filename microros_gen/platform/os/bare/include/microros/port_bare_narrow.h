/* SPDX-License-Identifier: Apache-2.0 */
/* For processors where an interrupt can come between two bytes of a number: what a task shares with an interrupt is read and
 * written while interrupts are off. Internal. */
#ifndef MICROROS_PORT_BARE_NARROW_H
#define MICROROS_PORT_BARE_NARROW_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Turns interrupts off; returns what port_bare_interrupts_restore() takes. A few instructions are allowed until then.
 * Implemented by the processor. */
uint8_t port_bare_interrupts_off(void);

/* Turns interrupts on again if they were on. Implemented by the processor. */
void port_bare_interrupts_restore(uint8_t state);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_BARE_NARROW_H */
