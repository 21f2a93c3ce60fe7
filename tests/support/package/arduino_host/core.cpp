/* SPDX-License-Identifier: Apache-2.0 */
#include "Arduino.h"
#include "WiFiUdp.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

HostSerial Serial;

static uint64_t now_us()
{
  struct timespec now;

  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<uint64_t>(now.tv_sec) * 1000000u + static_cast<uint64_t>(now.tv_nsec) / 1000u;
}

/* They start again after 2^32, as on a board: micros() shortly after the start. */
extern "C" unsigned long millis(void)
{
  return static_cast<uint32_t>(now_us() / 1000u);
}

extern "C" unsigned long micros(void)
{
  static const uint64_t start = now_us();

  return static_cast<uint32_t>(now_us() - start + 0xFFFFFFFFu - 3000000u);
}

extern "C" void delay(unsigned long ms)
{
  usleep(static_cast<useconds_t>(ms * 1000u));
}

extern "C" void yield(void)
{
  usleep(100);
}

size_t Print::write(const uint8_t * buffer, size_t size)
{
  size_t sent = 0;

  while (sent < size && write(buffer[sent]) == 1u) {
    ++sent;
  }
  return sent;
}

void HostSerial::begin(unsigned long)
{
  const char * device = getenv("ARDUINO_LINE");
  struct termios settings;

  line = open(device != nullptr ? device : "/dev/null", O_RDWR | O_NOCTTY);
  if (tcgetattr(line, &settings) == 0) {
    cfmakeraw(&settings);
    tcsetattr(line, TCSANOW, &settings);
  }
}

size_t HostSerial::write(uint8_t value)
{
  return write(&value, 1);
}

size_t HostSerial::write(const uint8_t * buffer, size_t size)
{
  const ssize_t sent = ::write(line, buffer, size);

  return sent < 0 ? 0u : static_cast<size_t>(sent);
}

int HostSerial::available()
{
  int waiting = 0;

  return ioctl(line, FIONREAD, &waiting) == 0 ? waiting : 0;
}

int HostSerial::read()
{
  uint8_t value;

  return available() > 0 && ::read(line, &value, 1) == 1 ? value : -1;
}

int HostSerial::peek()
{
  return -1;
}

uint8_t WiFiUDP::begin(uint16_t)
{
  udp = socket(AF_INET, SOCK_DGRAM, 0);
  return udp >= 0 ? 1 : 0;
}

void WiFiUDP::stop()
{
  close(udp);
  udp = -1;
}

int WiFiUDP::beginPacket(IPAddress address, uint16_t port)
{
  const char * other = getenv("ARDUINO_AGENT_PORT");

  peer = address;
  peer_port = other != nullptr ? static_cast<uint16_t>(atoi(other)) : port;
  output_size = 0;
  return 1;
}

int WiFiUDP::endPacket()
{
  const uint8_t bytes[4] = {peer[0], peer[1], peer[2], peer[3]};
  struct sockaddr_in to = {};

  to.sin_family = AF_INET;
  to.sin_port = htons(peer_port);
  memcpy(&to.sin_addr, bytes, sizeof(bytes));
  return sendto(udp, output, output_size, 0, reinterpret_cast<struct sockaddr *>(&to), sizeof(to)) ==
             static_cast<ssize_t>(output_size)
           ? 1
           : 0;
}

size_t WiFiUDP::write(uint8_t value)
{
  return write(&value, 1);
}

size_t WiFiUDP::write(const uint8_t * buffer, size_t size)
{
  if (size > sizeof(output) - output_size) {
    return 0;
  }
  memcpy(&output[output_size], buffer, size);
  output_size += size;
  return size;
}

int WiFiUDP::parsePacket()
{
  const ssize_t size = recv(udp, input, sizeof(input), MSG_DONTWAIT);

  input_size = size < 0 ? 0 : static_cast<int>(size);
  return input_size;
}

int WiFiUDP::available()
{
  return input_size;
}

int WiFiUDP::read()
{
  return -1;
}

int WiFiUDP::read(unsigned char * buffer, size_t size)
{
  const size_t taken = static_cast<size_t>(input_size) < size ? static_cast<size_t>(input_size) : size;

  memcpy(buffer, input, taken);
  input_size = 0;
  return static_cast<int>(taken);
}

int WiFiUDP::peek()
{
  return -1;
}

int main()
{
  setup();
  for (;;) {
    loop();
  }
}
