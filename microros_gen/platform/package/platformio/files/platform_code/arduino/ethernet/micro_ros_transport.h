/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICRO_ROS_TRANSPORT_H
#define MICRO_ROS_TRANSPORT_H

#include <Arduino.h>
#include <ETH.h>
#include <WiFi.h>
#include <WiFiUdp.h>

typedef void (*ethernet_event_callback_t)(arduino_event_id_t event, void * event_info);

struct micro_ros_agent_locator {
  IPAddress address;
  int port;
  ethernet_event_callback_t on_event;
};

/* The state of set_microros_ethernet_transports. Internal. */
static inline micro_ros_agent_locator & micro_ros_ethernet_locator()
{
  static micro_ros_agent_locator locator;

  return locator;
}

/* Internal. `event_info` of the callback is the address, an IPAddress, when there is one. */
static inline void micro_ros_ethernet_event(WiFiEvent_t event)
{
  IPAddress address = ETH.localIP();
  const bool has_address = event == ARDUINO_EVENT_ETH_GOT_IP;

  if (micro_ros_ethernet_locator().on_event != nullptr) {
    micro_ros_ethernet_locator().on_event(event, has_address ? &address : nullptr);
  }
}

/* Begins the Ethernet of an ESP32 with a fixed address, and uses UDP to the agent. The callback is called for each event of
 * the interface. */
static inline void set_microros_ethernet_transports(
  IPAddress client_ip, IPAddress gateway, IPAddress netmask, IPAddress agent_ip, uint16_t agent_port,
  const char * hostname = nullptr, ethernet_event_callback_t event_callback = nullptr)
{
  micro_ros_agent_locator & locator = micro_ros_ethernet_locator();

  locator.address = agent_ip;
  locator.port = agent_port;
  locator.on_event = event_callback;
  WiFi.onEvent(micro_ros_ethernet_event);
  ETH.begin();
  if (hostname != nullptr) {
    ETH.setHostname(hostname);
  }
  ETH.config(client_ip, gateway, netmask);
  delay(1000); /* until the link is up */
  (void)rmw_uros_set_custom_transport(
    false, &locator, platformio_transport_open, platformio_transport_close, platformio_transport_write,
    platformio_transport_read);
}

#endif /* MICRO_ROS_TRANSPORT_H */
