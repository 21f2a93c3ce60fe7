/* SPDX-License-Identifier: Apache-2.0 */
/* What the library asks of the HAL: time, sleep, the end of a wait and the number of the device. */
#include "microros_hal.h"

#include "microros/port.h"

#include <stddef.h>

#if MICROROS_USE_FREERTOS
#include "FreeRTOS.h"
#include "task.h"
#endif

static volatile bool is_woken;

void cubemx_rest(void)
{
#if MICROROS_USE_FREERTOS
  if (xTaskGetSchedulerState() == taskSCHEDULER_RUNNING) {
    vTaskDelay(1);
  } else {
    __WFI();
  }
#else
  __WFI(); /* the tick of the HAL ends it, too */
#endif
}

bool cubemx_rest_until(uint32_t start_ms, int timeout_ms)
{
  if (is_woken) {
    is_woken = false;
    return false;
  }
  if (timeout_ms <= 0 || (HAL_GetTick() - start_ms) >= (uint32_t)timeout_ms) {
    return false;
  }
  cubemx_rest();
  return true;
}

uint32_t port_time_ms(void)
{
  return HAL_GetTick();
}

/* The tick wraps after 49.7 days: the component long_time calls it in that time. From any task: a few instructions without
 * interrupts, because another task's reading in between would count a wrap twice. */
int64_t port_time_steady_ns(void)
{
  static uint32_t before;
  static uint32_t wraps;
  const uint32_t mask = __get_PRIMASK();
  int64_t steady_ms;
  uint32_t now;

  __disable_irq();
  now = HAL_GetTick();
  if (now < before) {
    ++wraps;
  }
  before = now;
  steady_ms = (int64_t)wraps * 4294967296 + (int64_t)now;
  __set_PRIMASK(mask);
  return steady_ms * 1000000;
}

/* 0: the time of day is not known. `+time_sync` asks the agent. */
int64_t port_time_epoch_ns(void)
{
  return 0;
}

/* MICROROS_TIME_US is a function of the project that returns microseconds in 32 bits, for example a timer's count. */
uint32_t port_time_us(void)
{
#if defined(MICROROS_TIME_US)
  extern uint32_t MICROROS_TIME_US(void);

  return MICROROS_TIME_US();
#else
  return HAL_GetTick() * 1000u;
#endif
}

void port_sleep_ms(uint32_t duration_ms)
{
  const uint32_t start_ms = HAL_GetTick();

  while ((HAL_GetTick() - start_ms) < duration_ms) {
    cubemx_rest();
  }
}

/* The library waits in the transport's read function. */
void port_wake(void)
{
  is_woken = true;
}

/* FNV-1a of the 96 bits that no other STM32 of its family has, so that each of them counts. */
uint32_t port_unique_id(void)
{
  const uint32_t words[3] = {HAL_GetUIDw0(), HAL_GetUIDw1(), HAL_GetUIDw2()};
  uint32_t id = 2166136261u;

  for (size_t i = 0; i < 12u; ++i) {
    id = (id ^ ((words[i / 4u] >> (8u * (i % 4u))) & 0xFFu)) * 16777619u;
  }
  return id == 0u ? 1u : id;
}
