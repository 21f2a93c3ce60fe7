/* SPDX-License-Identifier: Apache-2.0 */
#include "Arduino.h"

#include <poll.h>
#include <stdio.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

HostSerial Serial;

static uint64_t now_us()
{
  struct timespec now;

  clock_gettime(CLOCK_MONOTONIC, &now);
  return (uint64_t)now.tv_sec * 1000000u + (uint64_t)now.tv_nsec / 1000u;
}

/* Both wrap soon, as those of a board do after days. */
unsigned long millis(void)
{
  static const uint64_t start_us = now_us();

  return (uint32_t)((now_us() - start_us) / 1000u + UINT32_MAX - 2000u);
}

unsigned long micros(void)
{
  static const uint64_t start_us = now_us();

  return (uint32_t)(now_us() - start_us + UINT32_MAX - 1500000u);
}

void delay(unsigned long ms)
{
  usleep((useconds_t)(ms * 1000u));
}

void yield(void)
{
  usleep(200);
}

void HostSerial::begin(unsigned long)
{
}

void HostSerial::end()
{
}

int HostSerial::available()
{
  int count = 0;

  return ioctl(STDIN_FILENO, FIONREAD, &count) == 0 ? count : 0;
}

int HostSerial::read()
{
  uint8_t value;

  return available() > 0 && ::read(STDIN_FILENO, &value, 1) == 1 ? value : -1;
}

int HostSerial::peek()
{
  return -1;
}

size_t HostSerial::write(uint8_t value)
{
  return write(&value, 1);
}

size_t HostSerial::write(const uint8_t * data, size_t size)
{
  const ssize_t count = ::write(STDOUT_FILENO, data, size);

  return count > 0 ? (size_t)count : 0;
}

int main()
{
  setup();
  for (;;) {
    loop();
  }
}
