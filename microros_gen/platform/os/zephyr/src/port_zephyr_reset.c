/* SPDX-License-Identifier: Apache-2.0 */
/* The reset cause by Zephyr's driver of hwinfo; unknown without CONFIG_HWINFO, or where the driver does not tell it. */
#include "microros/port_diagnosis.h"
#include "microros/port_zephyr.h"

#include <stdbool.h>
#include <stddef.h>
#include <zephyr/drivers/hwinfo.h>

/* A driver may report several: one that happened inside the processor often pulls the pin as well. */
static port_reset_t reset_cause_of(uint32_t causes)
{
  static const struct {
    uint32_t bits;
    port_reset_t cause;
  } known[] = {
    {RESET_CPU_LOCKUP, PORT_RESET_FAULT},  {RESET_WATCHDOG, PORT_RESET_WATCHDOG},
    {RESET_SOFTWARE, PORT_RESET_SOFTWARE}, {RESET_BROWNOUT, PORT_RESET_BROWN_OUT},
    {RESET_POR, PORT_RESET_POWER},         {RESET_PIN, PORT_RESET_PIN},
  };

  for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); ++i) {
    if ((causes & known[i].bits) != 0u) {
      return known[i].cause;
    }
  }
  return PORT_RESET_UNKNOWN;
}

/* Causes stay over later resets until they are cleared. */
port_reset_t port_reset_cause(void)
{
  static port_reset_t cause;
#if defined(CONFIG_HWINFO)
  static bool is_known;

  if (!is_known) {
    uint32_t causes = 0;

    if (hwinfo_get_reset_cause(&causes) == 0) {
      cause = reset_cause_of(causes);
      (void)hwinfo_clear_reset_cause(); /* where a driver cannot, it reports the last one by itself */
    }
    is_known = true;
  }
#endif
  return cause;
}
