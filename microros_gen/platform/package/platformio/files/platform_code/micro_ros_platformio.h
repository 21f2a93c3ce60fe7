/* SPDX-License-Identifier: Apache-2.0 */
/* Include this header first: it declares the library, and set_microros_*_transports of `board_microros_transport`. */
#ifndef MICRO_ROS_PLATFORMIO_H
#define MICRO_ROS_PLATFORMIO_H

#include <rmw_microros/rmw_microros.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The four functions of the transport. With `board_microros_transport = custom` the application passes its own
 * functions to rmw_uros_set_custom_transport. */
bool platformio_transport_open(struct uxrCustomTransport * transport);
bool platformio_transport_close(struct uxrCustomTransport * transport);
size_t platformio_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err);
size_t platformio_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err);

#ifdef __cplusplus
}
#endif

#include <micro_ros_transport.h>

#endif /* MICRO_ROS_PLATFORMIO_H */
