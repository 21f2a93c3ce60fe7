/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"

#include <nuttx/config.h>
#include <stddef.h>
#include <sys/boardctl.h>

#if !defined(CONFIG_BOARDCTL_UNIQUEID)
#error "defconfig: set CONFIG_BOARDCTL_UNIQUEID=y, or session: {key: N} in the application file"
#endif

/* FNV-1a of the bytes that the board has, so that each of them counts. */
uint32_t port_unique_id(void)
{
  uint8_t bytes[CONFIG_BOARDCTL_UNIQUEID_SIZE];
  uint32_t id = 2166136261u;

  if (boardctl(BOARDIOC_UNIQUEID, (uintptr_t)bytes) == 0) {
    for (size_t i = 0; i < sizeof(bytes); ++i) {
      id = (id ^ bytes[i]) * 16777619u;
    }
  }
  return id == 0u ? 1u : id;
}
