/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_freertos.h"

#include "task.h"

static const uint64_t ms_per_s = 1000;

/* A count of 16 bits wraps within minutes. */
typedef char port_freertos_ticks_have_32_bits[sizeof(TickType_t) >= sizeof(uint32_t) ? 1 : -1];

/* The kernel counts the wraps of its ticks for time-outs, and reads both together. A count of 64 bits does not wrap. */
uint64_t port_freertos_now(void)
{
  TimeOut_t now;

  vTaskSetTimeOutState(&now);
  return (uint64_t)(uint32_t)now.xOverflowCount << 32 | (uint64_t)now.xTimeOnEntering;
}

/* Where a tick is a whole number of milliseconds, both counts wrap together. */
uint32_t port_time_ms(void)
{
  const uint32_t hz = (uint32_t)configTICK_RATE_HZ;
  uint64_t ticks;

  if ((uint32_t)ms_per_s % hz == 0u) {
    return (uint32_t)xTaskGetTickCount() * ((uint32_t)ms_per_s / hz);
  }
  ticks = port_freertos_now();
  return (uint32_t)(ticks / hz * ms_per_s + ticks % hz * ms_per_s / hz);
}

TickType_t port_freertos_ticks(uint32_t duration_ms)
{
  const uint64_t ticks = (duration_ms * (uint64_t)configTICK_RATE_HZ + ms_per_s - 1u) / ms_per_s;

  return ticks < portMAX_DELAY ? (TickType_t)ticks : (TickType_t)(portMAX_DELAY - 1u);
}

/* The current tick is not counted, so the time is never too short. */
void port_sleep_ms(uint32_t duration_ms)
{
  const TickType_t ticks = port_freertos_ticks(duration_ms);

  vTaskDelay(ticks != 0u && ticks < (TickType_t)(portMAX_DELAY - 1u) ? ticks + 1u : ticks);
}
