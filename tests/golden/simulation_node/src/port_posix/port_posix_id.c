/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"

#include <unistd.h>

enum { HOST_NAME_SIZE = 256 };

/* FNV-1a over the host's name: the nearest to a serial number that every POSIX system has. */
uint32_t port_unique_id(void)
{
  char name[HOST_NAME_SIZE] = {0};
  uint32_t hash = 2166136261u;

  if (gethostname(name, sizeof(name) - 1u) != 0) {
    name[0] = '\0';
  }
  for (const char * at = name; *at != '\0'; ++at) {
    hash = (hash ^ (uint8_t)*at) * 16777619u;
  }
  return hash == 0u ? 1u : hash;
}
