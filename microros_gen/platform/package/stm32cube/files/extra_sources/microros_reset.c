/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Why an STM32 has restarted, by the reset flags of RCC (RM0090, 7.3.21, RCC_CSR; other families name some flags
 * differently). A reset inside the processor pulls the pin, and power on sets the flag of a brown-out as well.
 */
#include "microros_hal.h"

#include "microros/port_diagnosis.h"

/* H7 has numbers for its watchdogs. */
#if defined(RCC_FLAG_IWDG1RST)
#define RESET_IWDG RCC_FLAG_IWDG1RST
#define RESET_WWDG RCC_FLAG_WWDG1RST
#else
#define RESET_IWDG RCC_FLAG_IWDGRST
#define RESET_WWDG RCC_FLAG_WWDGRST
#endif

/* An entry of stop or standby mode that the option bytes forbid. */
#if defined(RCC_FLAG_LPWR1RST)
#define RESET_LOW_POWER RCC_FLAG_LPWR1RST
#else
#define RESET_LOW_POWER RCC_FLAG_LPWRRST
#endif

/* Without a separate flag of power on, brown-outs are not told apart from it. */
#if defined(RCC_FLAG_PORRST)
#define RESET_POWER RCC_FLAG_PORRST
#elif defined(RCC_FLAG_PWRRST)
#define RESET_POWER RCC_FLAG_PWRRST
#else
#define RESET_POWER RCC_FLAG_BORRST
#endif

static port_reset_t reset_cause(void)
{
  if (__HAL_RCC_GET_FLAG(RESET_IWDG) != 0u || __HAL_RCC_GET_FLAG(RESET_WWDG) != 0u) {
    return PORT_RESET_WATCHDOG;
  }
  if (__HAL_RCC_GET_FLAG(RCC_FLAG_SFTRST) != 0u) {
    return PORT_RESET_SOFTWARE;
  }
#if defined(RCC_FLAG_OBLRST)
  if (__HAL_RCC_GET_FLAG(RCC_FLAG_OBLRST) != 0u) { /* the program or a programmer loads the option bytes */
    return PORT_RESET_SOFTWARE;
  }
#endif
  if (__HAL_RCC_GET_FLAG(RESET_POWER) != 0u) {
    return PORT_RESET_POWER;
  }
#if defined(RCC_FLAG_PORRST) && defined(RCC_FLAG_BORRST)
  if (__HAL_RCC_GET_FLAG(RCC_FLAG_BORRST) != 0u) {
    return PORT_RESET_BROWN_OUT;
  }
#endif
  if (__HAL_RCC_GET_FLAG(RESET_LOW_POWER) != 0u) {
    return PORT_RESET_UNKNOWN;
  }
  return __HAL_RCC_GET_FLAG(RCC_FLAG_PINRST) != 0u ? PORT_RESET_PIN : PORT_RESET_UNKNOWN;
}

/* Flags stay over later resets until they are cleared. */
port_reset_t port_reset_cause(void)
{
  static port_reset_t cause;
  static bool is_known;

  if (!is_known) {
    cause = reset_cause();
    __HAL_RCC_CLEAR_RESET_FLAGS();
    is_known = true;
  }
  return cause;
}
