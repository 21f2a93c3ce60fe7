/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_diagnosis.h"

#include "esp_timer.h"

uint32_t port_time_us(void)
{
  return (uint32_t)((uint64_t)esp_timer_get_time() & UINT32_MAX);
}
