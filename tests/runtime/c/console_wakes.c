/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A console that takes no line at first: console_wakes MS. A line is dropped. Prints how often the console was tried within MS
 * while it took nothing, how many lines it took after that, and how often threads then went to sleep within MS.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit_spinner.h"

#include <microros/port_console.h>
#include <rcutils/logging_macros.h>

static bool takes; /* the lock of the port guards these */
static unsigned tries;
static unsigned taken;

/* Called with the lock of the library, which is that of the port. */
bool port_console_write(const char * line, size_t size)
{
  (void)line;
  (void)size;
  ++tries;
  taken += takes ? 1u : 0u;
  return takes;
}

static unsigned tries_now(bool takes_now)
{
  unsigned count;

  port_lock();
  takes = takes_now;
  count = tries;
  port_unlock();
  return count;
}

int main(int count, char * arguments[])
{
  unsigned tried;
  unsigned long slept;
  uint32_t ms;

  CHECK(count == 2);
  ms = (uint32_t)strtoul(arguments[1], NULL, 10);
  spinner_open();
  spinner_start();
  tried = tries_now(false);
  RCUTILS_LOG_WARN_NAMED("writer", "dropped");
  port_sleep_ms(ms);
  (void)printf("%u ", tries_now(true) - tried);
  port_sleep_ms(SPINNER_SETTLED_MS);
  slept = spinner_sleeps(ms);
  port_lock();
  (void)printf("%u %lu\n", taken, slept);
  port_unlock();
  spinner_stop();
  return 0;
}
