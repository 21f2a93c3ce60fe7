/* SPDX-License-Identifier: Apache-2.0 */
/* The functions of the Pico SDK over a terminal: PICO_LINE names its device. */
#define _DEFAULT_SOURCE
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include <pico/stdlib.h>

static int line = -1;

bool stdio_init_all(void)
{
  struct termios settings;

  line = open(getenv("PICO_LINE"), O_RDWR | O_NOCTTY);
  if (line >= 0 && tcgetattr(line, &settings) == 0) {
    cfmakeraw(&settings);
    (void)tcsetattr(line, TCSANOW, &settings);
  }
  return line >= 0;
}

void stdio_flush(void)
{
}

int putchar_raw(int c)
{
  const uint8_t byte = (uint8_t)c;

  return write(line, &byte, 1) == 1 ? c : -1;
}

int getchar_timeout_us(uint32_t timeout_us)
{
  struct pollfd waiting = {line, POLLIN, 0};
  uint8_t byte;

  return poll(&waiting, 1, (int)((timeout_us + 999u) / 1000u)) > 0 && read(line, &byte, 1) == 1 ? byte : -1;
}

absolute_time_t get_absolute_time(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (absolute_time_t)now.tv_sec * 1000000u + (absolute_time_t)now.tv_nsec / 1000u;
}

uint32_t to_ms_since_boot(absolute_time_t time)
{
  return (uint32_t)(time / 1000u);
}

uint64_t to_us_since_boot(absolute_time_t time)
{
  return time;
}

void sleep_ms(uint32_t ms)
{
  (void)usleep((useconds_t)ms * 1000u);
}

void recursive_mutex_enter_blocking(recursive_mutex_t * mutex)
{
  ++mutex->depth;
}

void recursive_mutex_exit(recursive_mutex_t * mutex)
{
  --mutex->depth;
}

void pico_get_unique_board_id(pico_unique_board_id_t * board)
{
  (void)memset(board->id, 0xE6, sizeof(board->id));
}
