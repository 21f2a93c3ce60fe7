/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The serial line of POSIX with two tasks: waiting_line DEVICE. One waits for the line, longer than the test; then the other
 * one writes until there is no room, and prints how many bytes were taken. All of them leave during waits that end when
 * the terminal has room.
 */
#define _POSIX_C_SOURCE 200809L
#include "microros/lock.h"
#include "microros/port.h"

#include <pthread.h>
#include <stdio.h>

enum { PART = 32, BAUD = 115200, WAIT_MS = 60000, BEFORE_MS = 200 };

static port_serial_t serial;
static bool written;

static bool is_over(void)
{
  bool over;

  microros_lock();
  over = written && port_serial_is_idle(&serial);
  microros_unlock();
  return over;
}

static void * wait_for_line(void * context)
{
  (void)context;
  while (!is_over()) {
    port_wait(serial.handle, WAIT_MS);
  }
  return NULL;
}

int main(int argc, char ** argv)
{
  static const uint8_t part[PART];
  pthread_t task;
  unsigned size = 0;

  if (argc != 2 || !port_serial_open(&serial, argv[1], BAUD)) {
    return 2;
  }
  if (pthread_create(&task, NULL, wait_for_line, NULL) != 0) {
    return 3;
  }
  port_sleep_ms(BEFORE_MS); /* the task waits */
  microros_lock();
  while (port_serial_room(&serial) >= PART && port_serial_write(&serial, part, PART)) {
    size += PART;
  }
  written = true;
  microros_unlock();
  printf("%u\n", size);
  (void)fflush(stdout);
  if (pthread_join(task, NULL) != 0) {
    return 4;
  }
  port_serial_close(&serial);
  return 0;
}
