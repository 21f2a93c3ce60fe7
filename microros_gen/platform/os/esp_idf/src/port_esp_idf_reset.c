/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_diagnosis.h"

#include "esp_system.h"

port_reset_t port_reset_cause(void)
{
  switch (esp_reset_reason()) {
    case ESP_RST_POWERON:
      return PORT_RESET_POWER;
    case ESP_RST_EXT:
      return PORT_RESET_PIN;
    case ESP_RST_SW:
    case ESP_RST_DEEPSLEEP:
      return PORT_RESET_SOFTWARE;
    case ESP_RST_INT_WDT:
    case ESP_RST_TASK_WDT:
    case ESP_RST_WDT:
      return PORT_RESET_WATCHDOG;
    case ESP_RST_BROWNOUT:
      return PORT_RESET_BROWN_OUT;
    case ESP_RST_PANIC:
      return PORT_RESET_FAULT;
    default:
      return PORT_RESET_UNKNOWN;
  }
}
