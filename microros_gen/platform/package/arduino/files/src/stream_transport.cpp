/* SPDX-License-Identifier: Apache-2.0 */
/* The transports on streams of bytes: any Stream, and Serial. */
#include <micro_ros_arduino.h>

#include "micro_ros_arduino_wait.h"

/* Returns what has arrived, at least one byte unless the time is up. */
static size_t stream_read(Stream & stream, uint8_t * buffer, size_t length, int timeout)
{
  const uint32_t start_ms = millis();
  size_t count = 0;

  while (stream.available() <= 0) {
    if (!arduino_wait(start_ms, timeout)) {
      return 0;
    }
  }
  while (count < length && stream.available() > 0) {
    const int byte_or_none = stream.read();

    if (byte_or_none < 0) {
      break;
    }
    buffer[count] = (uint8_t)byte_or_none;
    ++count;
  }
  return count;
}

static bool stream_open(struct uxrCustomTransport * transport)
{
  return transport->args != NULL;
}

static bool stream_close(struct uxrCustomTransport * transport)
{
  (void)transport;
  return true;
}

static size_t stream_write_function(
  struct uxrCustomTransport * transport, const uint8_t * buffer, size_t length, uint8_t * error)
{
  (void)error;
  return ((Stream *)transport->args)->write(buffer, length);
}

static size_t stream_read_function(
  struct uxrCustomTransport * transport, uint8_t * buffer, size_t length, int timeout, uint8_t * error)
{
  (void)error;
  return stream_read(*(Stream *)transport->args, buffer, length, timeout);
}

bool set_microros_stream_transport(Stream & stream)
{
  return rmw_uros_set_custom_transport(
           true, &stream, stream_open, stream_close, stream_write_function, stream_read_function) ==
         RMW_RET_OK;
}

extern "C" {

bool __attribute__((weak)) arduino_transport_open(struct uxrCustomTransport * transport)
{
  (void)transport;
  Serial.begin(115200);
  return true;
}

bool __attribute__((weak)) arduino_transport_close(struct uxrCustomTransport * transport)
{
  (void)transport;
  Serial.end();
  return true;
}

size_t __attribute__((weak)) arduino_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buffer, size_t length, uint8_t * error)
{
  (void)transport;
  (void)error;
  return Serial.write(buffer, length);
}

size_t __attribute__((weak)) arduino_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buffer, size_t length, int timeout, uint8_t * error)
{
  (void)transport;
  (void)error;
  return stream_read(Serial, buffer, length, timeout);
}

} /* extern "C" */
