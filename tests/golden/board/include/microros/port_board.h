/* SPDX-License-Identifier: Apache-2.0 */
/* The board as constants, for the port's own files. Written by microros-gen: change the target file instead. */
#ifndef MICROROS_PORT_BOARD_H
#define MICROROS_PORT_BOARD_H

/* Of the system timer: 25000000 Hz. */
#define PORT_BOARD_TICKS_PER_MS 25000u
#define PORT_BOARD_HAS_FPU 1u
#define PORT_BOARD_INTERRUPTS 2u
#define PORT_BOARD_VECTORS 0x00000000u /* 0: where the processor looks by itself */

/* The serial line. The ring takes in what can arrive while nobody reads: one message of the longest kind and an
 * acknowledgement for each slot of the reliable stream. Its output waits in another one: transport.send_buffer. */
#define PORT_BOARD_UART 0x40004000u
#define PORT_BOARD_UART_IRQ 0u
#define PORT_BOARD_UART_TX_IRQ 1u
#define PORT_BOARD_UART_DIVISOR 217u
#define PORT_BOARD_UART_TX_PIN 0xffffffffu
#define PORT_BOARD_UART_RX_PIN 0xffffffffu
#define PORT_BOARD_UART_BAUD 115200u
#define PORT_BOARD_OUTPUT_SIZE 124u
#define PORT_BOARD_RING_SIZE 164u
#define PORT_BOARD_KEEPS_OUTPUT false /* messages of the reliable stream are not copied to it */

/* For each turn of a wait. */
static inline void port_board_watchdog(void)
{
}

#endif /* MICROROS_PORT_BOARD_H */
