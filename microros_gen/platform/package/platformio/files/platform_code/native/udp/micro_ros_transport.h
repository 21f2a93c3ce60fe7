/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICRO_ROS_TRANSPORT_H
#define MICRO_ROS_TRANSPORT_H

typedef struct micro_ros_agent_locator {
  const char * address; /* IPv4, as 127.0.0.1 */
  uint16_t port;
} micro_ros_agent_locator;

/* Reaches the agent by UDP at this address, whose text stays as it is. Call it before rclc_support_init. */
static inline void set_microros_udp_transports(const char * agent_ip, uint16_t agent_port)
{
  static micro_ros_agent_locator locator;

  locator.address = agent_ip;
  locator.port = agent_port;
  (void)rmw_uros_set_custom_transport(
    false, &locator, platformio_transport_open, platformio_transport_close, platformio_transport_write,
    platformio_transport_read);
}

#endif /* MICRO_ROS_TRANSPORT_H */
