/* SPDX-License-Identifier: Apache-2.0 */
/* The stand-ins over POSIX: standard input and output are the serial device of the computer named in BOARD_LINE. */
#include "pico/stdio.h"
#include "pico/time.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

static int line = -1;

bool stdio_init_all(void)
{
  line = open(getenv("BOARD_LINE"), O_RDWR | O_NOCTTY);
  return line >= 0;
}

int putchar_raw(int c)
{
  const unsigned char byte = (unsigned char)c;

  return write(line, &byte, 1) == 1 ? c : -1;
}

void stdio_flush(void)
{
}

int getchar_timeout_us(uint32_t timeout_us)
{
  struct pollfd input = {line, POLLIN, 0};
  unsigned char byte;

  return poll(&input, 1, (int)(timeout_us / 1000u)) > 0 && read(line, &byte, 1) == 1 ? byte : -1;
}

absolute_time_t get_absolute_time(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (uint64_t)now.tv_sec * 1000000u + (uint64_t)now.tv_nsec / 1000u;
}

uint32_t to_ms_since_boot(absolute_time_t t)
{
  return (uint32_t)(t / 1000u);
}

void sleep_ms(uint32_t ms)
{
  (void)usleep(ms * 1000u);
}
