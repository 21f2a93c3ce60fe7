/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A UART as the custom transport. `args` of the transport points to its number, a size_t:
 *
 *   static size_t uart = UART_NUM_1;
 *
 *   rmw_uros_set_custom_transport(
 *     true, &uart, esp32_serial_open, esp32_serial_close, esp32_serial_write, esp32_serial_read);
 *
 * Pins and speed are those of menuconfig, "UART Settings".
 */
#ifndef ESP32_SERIAL_TRANSPORT_H
#define ESP32_SERIAL_TRANSPORT_H

#include <rmw_microros/rmw_microros.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

bool esp32_serial_open(struct uxrCustomTransport * transport);
bool esp32_serial_close(struct uxrCustomTransport * transport);
size_t esp32_serial_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err);
size_t esp32_serial_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err);

#ifdef __cplusplus
}
#endif

#endif /* ESP32_SERIAL_TRANSPORT_H */
