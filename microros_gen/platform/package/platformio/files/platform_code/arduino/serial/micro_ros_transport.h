/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICRO_ROS_TRANSPORT_H
#define MICRO_ROS_TRANSPORT_H

#include <Arduino.h>

/* Any Stream: Serial, Serial1, a USB port. The sketch begins it with its speed; nothing else may write to it. */
static inline void set_microros_serial_transports(Stream & stream)
{
  (void)rmw_uros_set_custom_transport(
    true, &stream, platformio_transport_open, platformio_transport_close, platformio_transport_write,
    platformio_transport_read);
}

#endif /* MICRO_ROS_TRANSPORT_H */
