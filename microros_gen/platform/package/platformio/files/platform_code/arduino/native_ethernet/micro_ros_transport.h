/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICRO_ROS_TRANSPORT_H
#define MICRO_ROS_TRANSPORT_H

#include <Arduino.h>
#include <NativeEthernet.h>
#include <NativeEthernetUdp.h>

struct micro_ros_agent_locator {
  IPAddress address;
  int port;
};

/* Begins the Ethernet of a Teensy 4.1 with a fixed address, and uses UDP to the agent. */
static inline void set_microros_native_ethernet_transports(
  byte mac[], IPAddress client_ip, IPAddress agent_ip, uint16_t agent_port)
{
  static micro_ros_agent_locator locator;

  Ethernet.begin(mac, client_ip);
  delay(1000); /* until the link is up */
  locator.address = agent_ip;
  locator.port = agent_port;
  (void)rmw_uros_set_custom_transport(
    false, &locator, platformio_transport_open, platformio_transport_close, platformio_transport_write,
    platformio_transport_read);
}

#endif /* MICRO_ROS_TRANSPORT_H */
