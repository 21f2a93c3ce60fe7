/* SPDX-License-Identifier: Apache-2.0 */
/*
 * UDP over WiFi, with any library that has the objects `WiFi` and `WiFiUDP`: include its headers before this one.
 *
 *   #include <WiFiNINA.h>
 *   #include <WiFiUdp.h>
 *   #include <micro_ros_arduino.h>
 *   #include <micro_ros_arduino_wifi.h>
 */
#ifndef MICRO_ROS_ARDUINO_WIFI_H
#define MICRO_ROS_ARDUINO_WIFI_H

#include <micro_ros_arduino.h>

/* Joins the network, which can take as long as the network is away, and uses the agent at `agent_ip` ("192.168.1.10").
 * Returns false for a wrong address. */
static inline bool set_microros_wifi_transports(
  const char * ssid, const char * password, const char * agent_ip, uint16_t agent_port)
{
  static WiFiUDP udp;
  IPAddress address;

  if (!address.fromString(agent_ip)) {
    return false;
  }
#if defined(BOARD_WITH_ESP_AT)
  ESP_AT_SERIAL_PORT.begin(ESP_AT_BAUDRATE);
  WiFi.init(ESP_AT_SERIAL_PORT, ESP_AT_RESET_PIN);
  while (WiFi.status() == WL_NO_MODULE) {
    delay(100);
  }
#endif
  WiFi.begin((char *)ssid, (char *)password); /* some libraries take no const */
  while (WiFi.status() != WL_CONNECTED) {
    delay(100);
  }
  return set_microros_udp_transport(udp, address, agent_port);
}

#endif /* MICRO_ROS_ARDUINO_WIFI_H */
