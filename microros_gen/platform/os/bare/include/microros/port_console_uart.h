/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Between the console of a board and the driver that sends its bytes. Log messages, and what the program prints if `stdio`
 * names the same UART, wait in a ring until the driver's interrupt, or a DMA controller, has sent them. Only the task
 * writes one end of the ring and only the interrupt the other, so no lock is needed.
 *
 * For a UART without a driver of this project, `provides: [console_send]` in the target file leaves port_console_send() to
 * the application (docs/howto/port.md).
 */
#ifndef MICROROS_PORT_CONSOLE_UART_H
#define MICROROS_PORT_CONSOLE_UART_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Implemented by the driver: the ring has bytes. The first call turns the UART on. Enables the transmit interrupt, or
 * starts a transfer unless one is in progress; does not wait. */
void port_console_send(void);

/* For the driver's interrupt: takes the next byte to send from the ring. Returns false if it is empty. */
bool port_console_next(uint8_t * byte);

/* For DMA: sets `bytes` to the next bytes to send and returns how many are contiguous, 0 if the ring is empty. They stay
 * valid until the interrupt at the end of the transfer calls port_console_sent(), which frees `count` of them. */
uint32_t port_console_unsent(const volatile uint8_t ** bytes);
void port_console_sent(uint32_t count);

/* For the task: puts `size` bytes into the ring, all or none. Returns false if they do not fit. */
bool port_console_put(const uint8_t * bytes, size_t size);

/* For the task, before a reset or deep sleep: returns whether the driver has taken all bytes. */
bool port_console_is_idle(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_CONSOLE_UART_H */
