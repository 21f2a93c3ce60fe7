/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The transport of a Pico: the standard input and output of the Pico SDK, over USB or a UART (pico_enable_stdio_usb,
 * pico_enable_stdio_uart; enable one of them). The program must not print anything.
 */
#ifndef PICO_UART_TRANSPORTS_H
#define PICO_UART_TRANSPORTS_H

#include <uxr/client/transport.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

bool pico_serial_transport_open(struct uxrCustomTransport * transport);
bool pico_serial_transport_close(struct uxrCustomTransport * transport);
size_t pico_serial_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err);
size_t pico_serial_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err);

#ifdef __cplusplus
}
#endif

#endif /* PICO_UART_TRANSPORTS_H */
