/* SPDX-License-Identifier: Apache-2.0 */
/* port_wait of POSIX with the handle of a pipe that can be read: argument `looks`: it returns at once; `ignores`: after
 * its time-out, or a call of port_wake. */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"

#include <string.h>
#include <unistd.h>

enum { SHORT_MS = 50, LONG_MS = 600000 };

static bool waits_to_the_end(intptr_t handle)
{
  const uint32_t start_ms = port_time_ms();

  port_wait(handle, SHORT_MS);
  return port_time_ms() - start_ms >= (uint32_t)SHORT_MS - 1u;
}

int main(int count, const char * const * arguments)
{
  int ends[2];

  if (count != 2 || pipe(ends) != 0 || write(ends[1], "x", 1) != 1) {
    return 2;
  }
  port_wake();
  port_wait(-1, LONG_MS); /* a wake before it ends it */
  if (strcmp(arguments[1], "looks") == 0) {
    port_wait(ends[0], LONG_MS);
    return 0;
  }
  return waits_to_the_end(ends[0]) && waits_to_the_end(0) ? 0 : 1;
}
