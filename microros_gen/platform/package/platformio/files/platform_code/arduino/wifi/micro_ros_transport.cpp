/* SPDX-License-Identifier: Apache-2.0 */
#include <micro_ros_udp.h>

static WiFiUDP udp;

extern "C" bool platformio_transport_open(struct uxrCustomTransport *)
{
  return micro_ros_udp_open(udp);
}

extern "C" bool platformio_transport_close(struct uxrCustomTransport *)
{
  udp.stop();
  return true;
}

extern "C" size_t platformio_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  return micro_ros_udp_write(udp, static_cast<micro_ros_agent_locator *>(transport->args), buf, len, err);
}

extern "C" size_t platformio_transport_read(
  struct uxrCustomTransport *, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  return micro_ros_udp_read(udp, buf, len, timeout, err);
}
