/* SPDX-License-Identifier: Apache-2.0 */
/* The reset cause that the board tells; unknown without CONFIG_BOARDCTL_RESET_CAUSE. */
#include "microros/port_diagnosis.h"

#include <nuttx/config.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/boardctl.h>

#if defined(CONFIG_BOARDCTL_RESET_CAUSE)
static port_reset_t reset_cause_of(enum boardioc_reset_cause_e cause)
{
  switch (cause) {
    case BOARDIOC_RESETCAUSE_SYS_CHIPPOR:
      return PORT_RESET_POWER;
    case BOARDIOC_RESETCAUSE_PIN:
      return PORT_RESET_PIN;
    case BOARDIOC_RESETCAUSE_SYS_BOR:
      return PORT_RESET_BROWN_OUT;
    case BOARDIOC_RESETCAUSE_CORE_SOFT:
    case BOARDIOC_RESETCAUSE_CORE_DPSP:
    case BOARDIOC_RESETCAUSE_CPU_SOFT:
      return PORT_RESET_SOFTWARE;
    case BOARDIOC_RESETCAUSE_SYS_RWDT:
    case BOARDIOC_RESETCAUSE_CORE_MWDT:
    case BOARDIOC_RESETCAUSE_CORE_RWDT:
    case BOARDIOC_RESETCAUSE_CPU_MWDT:
    case BOARDIOC_RESETCAUSE_CPU_RWDT:
      return PORT_RESET_WATCHDOG;
    default:
      return PORT_RESET_UNKNOWN;
  }
}
#endif

/* Asked once: boards clear the cause when it is read. */
port_reset_t port_reset_cause(void)
{
  static port_reset_t cause;
#if defined(CONFIG_BOARDCTL_RESET_CAUSE)
  static bool is_known;

  if (!is_known) {
    struct boardioc_reset_cause_s found;

    if (boardctl(BOARDIOC_RESET_CAUSE, (uintptr_t)&found) == 0) {
      cause = reset_cause_of(found.cause);
    }
    is_known = true;
  }
#endif
  return cause;
}
