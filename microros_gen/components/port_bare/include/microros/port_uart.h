/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Between the serial line of microros/port.h and the driver of a UART. What the receive interrupt takes in waits in a ring
 * until the task reads it: one interrupt puts, one task takes.
 */
#ifndef MICROROS_PORT_UART_H
#define MICROROS_PORT_UART_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How long a driver waits for room for one byte: 115200 baud need 0.09 ms, 1200 baud 8.4. */
enum { PORT_UART_BYTE_TIMEOUT_MS = 10 };

/* Of the driver: turns the UART on at PORT_BOARD_UART_BAUD, 8 bits, no parity, one stop bit, and lets its receive interrupt
 * through. */
void port_uart_start(void);

/* Of the driver: turns it off. */
void port_uart_stop(void);

/* Of the driver: hands one byte over, waiting for room. False: there was none in PORT_UART_BYTE_TIMEOUT_MS. */
bool port_uart_put(uint8_t byte);

/* For the driver's interrupt: a byte has come; a full ring counts it as lost. One byte an interrupt: between two of them
 * others have their turn, however fast the line is. */
void port_uart_received(uint8_t byte);

/* For the driver's interrupt: the hardware lost a byte. */
void port_uart_lost(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_UART_H */
