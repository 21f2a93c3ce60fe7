/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Connects the serial line of microros/port.h to the driver of a UART. Received bytes wait in one ring until the task reads
 * them; bytes to send wait in another one until the transmit interrupt, or a DMA controller, has sent them. Only the task
 * writes one end of each ring and only the interrupt the other, so no lock is needed.
 *
 * Your own driver consists of three functions and an interrupt that calls the others. `uart: {driver: application}` of the
 * target file leaves them to the application (docs/howto/port.md).
 */
#ifndef MICROROS_PORT_UART_H
#define MICROROS_PORT_UART_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Implemented by the driver: turns the UART on at PORT_BOARD_UART_BAUD, 8 bits, no parity, one stop bit, and enables its
 * interrupts. */
void port_uart_start(void);

/* Implemented by the driver: turns the UART off, and no longer reads the ring. */
void port_uart_stop(void);

/* Implemented by the driver: the ring has bytes to send. Enables the transmit interrupt, or starts a DMA transfer unless one
 * is in progress; does not wait. */
void port_uart_send(void);

/* For the driver's interrupt: takes the next byte to send from the ring. Returns false if it is empty. */
bool port_uart_next(uint8_t * byte);

/* For DMA: sets `bytes` to the next bytes to send and returns how many are contiguous, 0 if there is nothing to send. They
 * are one transfer and stay valid until the interrupt at its end calls port_uart_sent(), which frees `count` of them. */
uint32_t port_uart_unsent(const volatile uint8_t ** bytes);
void port_uart_sent(uint32_t count);

/* For the driver's interrupt: takes a received byte; a full ring counts it as lost. Takes one byte per interrupt, so other
 * interrupts run in between, however fast the line is. */
void port_uart_received(uint8_t byte);

/* For the driver's interrupt: the hardware lost a byte. */
void port_uart_lost(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_UART_H */
