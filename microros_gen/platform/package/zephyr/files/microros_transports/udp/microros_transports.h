/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A UDP socket of Zephyr as the custom transport:
 *
 *   rmw_uros_set_custom_transport(
 *     MICRO_ROS_FRAMING_REQUIRED, (void *)&default_params, zephyr_transport_open, zephyr_transport_close,
 *     zephyr_transport_write, zephyr_transport_read);
 *
 * default_params has the address of menuconfig; a program may write another one to `ip` and `port`. The network is up
 * before.
 */
#ifndef MICROROS_TRANSPORTS_H
#define MICROROS_TRANSPORTS_H

#include <uxr/client/transport.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <zephyr/net/socket.h>

#ifdef __cplusplus
extern "C" {
#endif

#define MICRO_ROS_FRAMING_REQUIRED false

typedef struct zephyr_transport_params_t {
  struct zsock_pollfd poll_fd;
  char ip[46]; /* an address of IPv6 is longer than the 16 of micro_ros_zephyr_module */
  char port[6];
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
