/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_zephyr.h"

#include <stddef.h>
#include <sys/types.h>
#include <zephyr/drivers/hwinfo.h>

#if !defined(CONFIG_HWINFO)
#error "prj.conf: set CONFIG_HWINFO=y, or session: {key: N} in the application file"
#endif

enum { BYTES = 16 };

/* FNV-1a of the bytes that the device has, so that each of them counts. */
uint32_t port_unique_id(void)
{
  uint8_t bytes[BYTES];
  const ssize_t size = hwinfo_get_device_id(bytes, sizeof(bytes));
  uint32_t id = 2166136261u;

  for (ssize_t i = 0; i < size; ++i) {
    id = (id ^ bytes[i]) * 16777619u;
  }
  return id == 0u ? 1u : id;
}
