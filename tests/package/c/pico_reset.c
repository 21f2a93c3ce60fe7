/* SPDX-License-Identifier: Apache-2.0 */
/* Prints the cause of a reset, twice, with the registers of a Pico in the environment: CHIP_RESET, REASON, MAGIC. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <hardware/watchdog.h>
#include <microros/port_diagnosis.h>

#if PICO_RP2040
#include <hardware/structs/vreg_and_chip_reset.h>
typedef vreg_and_chip_reset_hw_t chip_reset_t;
#else
#include <hardware/structs/powman.h>
typedef powman_hw_t chip_reset_t;
#endif

static bool was_enabled_since;

chip_reset_t * pico_chip_reset(void)
{
  static chip_reset_t registers;

  registers.chip_reset = (uint32_t)strtoul(getenv("CHIP_RESET"), NULL, 0);
  return &registers;
}

bool watchdog_caused_reboot(void)
{
  return getenv("REASON") != NULL;
}

bool watchdog_enable_caused_reboot(void)
{
  return watchdog_caused_reboot() && (was_enabled_since || getenv("MAGIC") != NULL);
}

int main(void)
{
  was_enabled_since = true; /* watchdog_enable of the program */
  (void)printf("%d", (int)port_reset_cause());
  (void)printf("%d", (int)port_reset_cause());
  return 0;
}
