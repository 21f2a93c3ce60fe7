/* SPDX-License-Identifier: Apache-2.0 */
/*
 * UDP over Ethernet, with any library that has the objects `Ethernet` and `EthernetUDP`: include its headers before this
 * one.
 *
 *   #include <SPI.h>
 *   #include <Ethernet.h>
 *   #include <EthernetUdp.h>
 *   #include <micro_ros_arduino.h>
 *   #include <micro_ros_arduino_ethernet.h>
 */
#ifndef MICRO_ROS_ARDUINO_ETHERNET_H
#define MICRO_ROS_ARDUINO_ETHERNET_H

#include <micro_ros_arduino.h>

/* Begins with a fixed address, waits for the cable, and uses the agent at `agent_ip`. */
static inline bool set_microros_native_ethernet_udp_transports(
  uint8_t mac[], IPAddress client_ip, IPAddress agent_ip, uint16_t agent_port)
{
  static EthernetUDP udp;

  Ethernet.begin(mac, client_ip);
  while (Ethernet.linkStatus() == LinkOFF) {
    delay(100);
  }
  return set_microros_udp_transport(udp, agent_ip, agent_port);
}

#endif /* MICRO_ROS_ARDUINO_ETHERNET_H */
