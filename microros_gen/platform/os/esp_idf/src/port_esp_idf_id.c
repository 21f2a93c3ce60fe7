/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"

#include "sdkconfig.h"

#ifdef CONFIG_IDF_TARGET_LINUX
#include "esp_random.h"

static uint32_t number;

/* The computer that builds has no number of a chip: one for each run. */
uint32_t port_unique_id(void)
{
  while (number == 0u) {
    number = esp_random();
  }
  return number;
}
#else
#include "esp_mac.h"

#include <stddef.h>

enum { BYTES = 8 }; /* of an EUI-64 address; most chips have one of 6 bytes */

/* FNV-1a of the address in the chip's fuses, so that each of its bytes counts. */
uint32_t port_unique_id(void)
{
  uint8_t bytes[BYTES] = {0};
  uint32_t id = 2166136261u;

  if (esp_efuse_mac_get_default(bytes) != ESP_OK) {
    return 1;
  }
  for (size_t i = 0; i < sizeof(bytes); ++i) {
    id = (id ^ bytes[i]) * 16777619u;
  }
  return id == 0u ? 1u : id;
}
#endif
