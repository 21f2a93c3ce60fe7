/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICRO_ROS_TRANSPORT_H
#define MICRO_ROS_TRANSPORT_H

#include <Arduino.h>
#include <WiFi.h>
#include <WiFiUdp.h>

struct micro_ros_agent_locator {
  IPAddress address;
  int port;
};

/* Joins the Wi-Fi network, waits until that has succeeded, and uses UDP to the agent. */
static inline void set_microros_wifi_transports(
  const char * ssid, const char * pass, IPAddress agent_ip, uint16_t agent_port)
{
  static micro_ros_agent_locator locator;

  WiFi.begin(const_cast<char *>(ssid), const_cast<char *>(pass)); /* some cores have char * */
  while (WiFi.status() != WL_CONNECTED) {
    delay(500);
  }
  locator.address = agent_ip;
  locator.port = agent_port;
  (void)rmw_uros_set_custom_transport(
    false, &locator, platformio_transport_open, platformio_transport_close, platformio_transport_write,
    platformio_transport_read);
}

#endif /* MICRO_ROS_TRANSPORT_H */
