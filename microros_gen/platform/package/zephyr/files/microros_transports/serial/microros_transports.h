/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A UART of Zephyr, or USB as one, as the custom transport:
 *
 *   rmw_uros_set_custom_transport(
 *     MICRO_ROS_FRAMING_REQUIRED, (void *)&default_params, zephyr_transport_open, zephyr_transport_close,
 *     zephyr_transport_write, zephyr_transport_read);
 *
 * The devicetree names the device by the alias microros-uart; a program may write another one to default_params.uart_dev.
 * The transport can be open for one device at a time.
 */
#ifndef MICROROS_TRANSPORTS_H
#define MICROROS_TRANSPORTS_H

#include <uxr/client/transport.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <zephyr/device.h>

#ifdef __cplusplus
extern "C" {
#endif

#define MICRO_ROS_FRAMING_REQUIRED true

typedef struct zephyr_transport_params_t {
  const struct device * uart_dev;
} zephyr_transport_params_t;

extern zephyr_transport_params_t default_params;

bool zephyr_transport_open(struct uxrCustomTransport * transport);
bool zephyr_transport_close(struct uxrCustomTransport * transport);
size_t zephyr_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err);
size_t zephyr_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_TRANSPORTS_H */
