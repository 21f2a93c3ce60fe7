/* SPDX-License-Identifier: Apache-2.0 */
/* The number of the chip, so that each Teensy has its own client key. */
#include "microros/port.h"

#include <Arduino.h>

/* FNV-1a, so that each byte counts. */
static uint32_t hash(uint32_t id, uint32_t word)
{
  for (uint8_t shift = 0; shift < 32u; shift += 8u) {
    id = (id ^ ((word >> shift) & 0xFFu)) * 16777619u;
  }
  return id;
}

uint32_t port_unique_id(void)
{
  uint32_t id = 2166136261u;

#if defined(__IMXRT1062__) /* Teensy 4 */
  id = hash(id, HW_OCOTP_CFG0);
  id = hash(id, HW_OCOTP_CFG1);
#else /* Teensy 3, LC */
#if defined(SIM_UIDH)
  id = hash(id, SIM_UIDH);
#endif
  id = hash(id, SIM_UIDMH);
  id = hash(id, SIM_UIDML);
  id = hash(id, SIM_UIDL);
#endif
  return id == 0u ? 1u : id;
}
