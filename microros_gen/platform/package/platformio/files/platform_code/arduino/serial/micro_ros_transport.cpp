/* SPDX-License-Identifier: Apache-2.0 */
#include <Arduino.h>

#include <micro_ros_platformio.h>

static Stream & stream_of(const struct uxrCustomTransport * transport)
{
  return *static_cast<Stream *>(transport->args);
}

extern "C" bool platformio_transport_open(struct uxrCustomTransport *)
{
  return true;
}

extern "C" bool platformio_transport_close(struct uxrCustomTransport *)
{
  return true;
}

extern "C" size_t platformio_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  const size_t sent = stream_of(transport).write(buf, len);

  *err = sent == 0u && len != 0u ? 1u : 0u;
  return sent;
}

/* Waits for the first byte alone: the library calls again for more. */
extern "C" size_t platformio_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  Stream & stream = stream_of(transport);
  const unsigned long start = millis();
  size_t size = 0;

  *err = 0;
  while (stream.available() <= 0) {
    if (millis() - start >= static_cast<unsigned long>(timeout)) {
      return 0;
    }
    yield();
  }
  while (size < len && stream.available() > 0) {
    buf[size] = static_cast<uint8_t>(stream.read());
    ++size;
  }
  return size;
}
