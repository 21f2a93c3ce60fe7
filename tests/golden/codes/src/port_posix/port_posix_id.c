/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"

#include <fcntl.h>
#include <time.h>
#include <unistd.h>

/* Without random numbers of the system: the process id and the current time. */
static uint32_t id_of_process(void)
{
  struct timespec now = {0, 0};
  uint32_t id = (uint32_t)getpid() * 2654435761u;

  if (clock_gettime(CLOCK_REALTIME, &now) == 0) {
    id ^= (uint32_t)now.tv_nsec ^ (uint32_t)now.tv_sec << 16;
  }
  return id;
}

/* Drawn once per process: two programs on one machine differ, and a program that initializes again keeps its id. */
uint32_t port_unique_id(void)
{
  static uint32_t id;

  if (id == 0u) {
    const int source = open("/dev/urandom", O_RDONLY | O_CLOEXEC);

    if (source < 0 || read(source, &id, sizeof(id)) != (ssize_t)sizeof(id)) {
      id = id_of_process();
    }
    if (source >= 0) {
      (void)close(source);
    }
    id = id == 0u ? 1u : id;
  }
  return id;
}
