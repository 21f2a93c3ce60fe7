/* SPDX-License-Identifier: Apache-2.0 */
/* The transport over a class UDP of Arduino, for all networks: included by the source of each of them. */
#ifndef MICRO_ROS_UDP_H
#define MICRO_ROS_UDP_H

#include <Arduino.h>
#include <IPAddress.h>
#include <Udp.h>

#include <micro_ros_platformio.h>

enum { MICRO_ROS_UDP_PORT = 8888 }; /* of the board */

static inline bool micro_ros_udp_open(UDP & udp)
{
  return udp.begin(MICRO_ROS_UDP_PORT) == 1;
}

/* Returns 0 if the datagram was not sent whole. */
static inline size_t micro_ros_udp_write(
  UDP & udp, const micro_ros_agent_locator * agent, const uint8_t * buf, size_t len, uint8_t * err)
{
  const bool is_sent = udp.beginPacket(agent->address, static_cast<uint16_t>(agent->port)) == 1 &&
                       udp.write(buf, len) == len && udp.endPacket() == 1;

  *err = is_sent ? 0u : 1u;
  return is_sent ? len : 0u;
}

/* Returns one datagram; more than `len` bytes of it are dropped. */
static inline size_t micro_ros_udp_read(UDP & udp, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  const unsigned long start = millis();

  *err = 0;
  for (;;) {
    if (udp.parsePacket() > 0) {
      const int size = udp.read(buf, len);

      return size > 0 ? static_cast<size_t>(size) : 0u;
    }
    if (millis() - start >= static_cast<unsigned long>(timeout)) {
      return 0;
    }
    delay(1);
  }
}

#endif /* MICRO_ROS_UDP_H */
