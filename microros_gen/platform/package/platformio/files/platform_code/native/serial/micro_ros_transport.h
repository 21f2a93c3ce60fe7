/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICRO_ROS_TRANSPORT_H
#define MICRO_ROS_TRANSPORT_H

/* Uses the serial line `device` (/dev/ttyUSB0, or a pseudo-terminal), raw, with the speed that it has. The text stays as it
 * is while the library runs. Call it before rclc_support_init. */
static inline void set_microros_serial_transports(const char * device)
{
  (void)rmw_uros_set_custom_transport(
    true, (void *)(uintptr_t)device, platformio_transport_open, platformio_transport_close,
    platformio_transport_write, platformio_transport_read);
}

#endif /* MICRO_ROS_TRANSPORT_H */
