/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_freertos.h"
#include "microros/port_tasks.h"
#include "microros_config.h"

#include "semphr.h"
#include "task.h"

#include <stddef.h>

#if !defined(configMAX_PRIORITIES) || configMAX_PRIORITIES <= MICROROS_TASKS
#error "FreeRTOSConfig.h: set configMAX_PRIORITIES above MICROROS_TASKS of microros_config.h"
#endif
#if !defined(INCLUDE_vTaskDelete) || INCLUDE_vTaskDelete != 1
#error "FreeRTOSConfig.h: set INCLUDE_vTaskDelete to 1"
#endif
#if !defined(INCLUDE_vTaskPrioritySet) || INCLUDE_vTaskPrioritySet != 1
#error "FreeRTOSConfig.h: set INCLUDE_vTaskPrioritySet to 1"
#endif
#if !defined(INCLUDE_vTaskSuspend) || INCLUDE_vTaskSuspend != 1
#error "FreeRTOSConfig.h: set INCLUDE_vTaskSuspend to 1"
#endif
#if !defined(INCLUDE_xTaskDelayUntil) || INCLUDE_xTaskDelayUntil != 1
#error "FreeRTOSConfig.h: set INCLUDE_xTaskDelayUntil to 1"
#endif
#if !defined(INCLUDE_xTaskGetCurrentTaskHandle) || INCLUDE_xTaskGetCurrentTaskHandle != 1
#error "FreeRTOSConfig.h: set INCLUDE_xTaskGetCurrentTaskHandle to 1"
#endif
#if !defined(INCLUDE_uxTaskGetStackHighWaterMark) || INCLUDE_uxTaskGetStackHighWaterMark != 1
#error "FreeRTOSConfig.h: set INCLUDE_uxTaskGetStackHighWaterMark to 1"
#endif

/* ESP-IDF before 5.2 has only its own name for the number of cores. */
#if (defined(configNUMBER_OF_CORES) && configNUMBER_OF_CORES > 1) || \
  (defined(portNUM_PROCESSORS) && portNUM_PROCESSORS > 1)
#define TASKS_RUN_AT_ONCE 1
#if !defined(INCLUDE_eTaskGetState) || INCLUDE_eTaskGetState != 1
#error "FreeRTOSConfig.h: set INCLUDE_eTaskGetState to 1"
#endif
#else
#define TASKS_RUN_AT_ONCE 0
#endif

typedef struct kernel_task_t {
  StaticTask_t storage;
  StaticSemaphore_t event_storage;
  SemaphoreHandle_t event;
  TaskHandle_t handle; /* NULL: not made */
  const port_task_t * setting;
  uint8_t task;
  volatile bool has_ended;
} kernel_task_t;

static const uint64_t us_per_s = 1000000;

static kernel_task_t kernel_tasks[MICROROS_TASKS];

static void task_begin(void * argument)
{
  kernel_task_t * place = (kernel_task_t *)argument;

  place->handle = xTaskGetCurrentTaskHandle(); /* another processor may run it before its creation returns */
  place->setting->entry(place->task);
  place->has_ended = true;
  for (;;) {
    vTaskSuspend(NULL); /* until port_task_join deletes it: a function of a task must not return */
  }
}

/* No other task runs before the handle is known: the new one may have a higher priority than the caller. */
bool port_task_create(uint8_t task, const port_task_t * setting)
{
  kernel_task_t * place = &kernel_tasks[task];

  place->setting = setting;
  place->task = task;
  place->has_ended = false;
  if (place->event == NULL) {
    place->event = xSemaphoreCreateBinaryStatic(&place->event_storage); /* with storage, it cannot fail */
  }
  vTaskSuspendAll();
  place->handle = xTaskCreateStatic(
    task_begin, setting->name, setting->stack_size / (uint32_t)sizeof(StackType_t), place,
    (UBaseType_t)tskIDLE_PRIORITY + setting->priority, (StackType_t *)setting->stack, &place->storage);
  (void)xTaskResumeAll();
  return place->handle != NULL;
}

#if TASKS_RUN_AT_ONCE == 1
/* On another processor it may still be on its way to its suspension; its stack and storage are used until then. */
static bool task_is_over(const kernel_task_t * place)
{
  return place->has_ended && eTaskGetState(place->handle) == eSuspended;
}
#else
/* The caller runs, so the task does not. */
static bool task_is_over(const kernel_task_t * place)
{
  return place->has_ended;
}
#endif

void port_task_join(uint8_t task)
{
  kernel_task_t * place = &kernel_tasks[task];

  while (!task_is_over(place)) {
    vTaskDelay(1);
  }
  vTaskDelete(place->handle);
  place->handle = NULL;
}

uint8_t port_task_self(void)
{
  const TaskHandle_t self = xTaskGetCurrentTaskHandle();

  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    if (kernel_tasks[task].handle == self) {
      return task;
    }
  }
  return (uint8_t)PORT_TASK_NONE;
}

bool port_task_has_priorities(void)
{
  return true;
}

bool port_task_set_priority(uint8_t task, uint8_t priority)
{
  vTaskPrioritySet(kernel_tasks[task].handle, (UBaseType_t)tskIDLE_PRIORITY + priority);
  return true;
}

void port_task_set(uint8_t task)
{
  (void)xSemaphoreGive(kernel_tasks[task].event); /* fails if it is given already */
}

void port_task_wait(uint8_t task, uint32_t timeout_ms)
{
  (void)xSemaphoreTake(
    kernel_tasks[task].event, port_freertos_ticks(timeout_ms)); /* false: the time has passed */
}

/* Returns microseconds at a tick, which wrap. */
static uint32_t tick_time_us(uint64_t ticks)
{
  const uint64_t hz = (uint64_t)configTICK_RATE_HZ;

  return (uint32_t)((ticks / hz * us_per_s + ticks % hz * us_per_s / hz) & UINT32_MAX);
}

#ifdef PORT_FREERTOS_TIME_US
#ifdef ESP_PLATFORM
/* vTaskSuspendAll of ESP-IDF stops the tasks of the caller's core only. */
static portMUX_TYPE clock_guard = portMUX_INITIALIZER_UNLOCKED;

static void clock_enter(void)
{
  portENTER_CRITICAL(&clock_guard);
}

static void clock_leave(void)
{
  portEXIT_CRITICAL(&clock_guard);
}
#else
static void clock_enter(void)
{
  vTaskSuspendAll();
}

static void clock_leave(void)
{
  (void)xTaskResumeAll();
}
#endif

/* What the timer of the application showed at a tick, less the time of the tick: the least that was seen, because it is
 * read after the tick. Written between clock_enter and clock_leave. */
static uint32_t timer_lead_us;
static uint32_t timer_lost_us; /* the tick at which it was unknown */
static bool timer_is_known;

/* Returns the microseconds since the tick at `tick_us`, less than a tick. If the timer is far ahead, the kernel has missed
 * ticks: then the time stays until the next one. */
static uint32_t since_tick_us(uint32_t tick_us, uint32_t timer_us)
{
  const uint32_t most_us = (uint32_t)(us_per_s / (uint64_t)configTICK_RATE_HZ) - 1u;
  uint32_t since_us = timer_us - tick_us - timer_lead_us;

  if (since_us > (uint32_t)INT32_MAX || (!timer_is_known && tick_us != timer_lost_us)) {
    timer_is_known = true;
    timer_lead_us = timer_us - tick_us;
    since_us = 0;
  } else if (since_us > most_us + most_us) {
    timer_is_known = false;
    timer_lost_us = tick_us;
  } else {
    /* as it was expected */
  }
  return since_us < most_us ? since_us : most_us;
}

/* The timer counts between the ticks. Each tick is at its own time, so that a sleep until then ends with the tick. */
uint32_t port_task_time_us(void)
{
  uint32_t time_us;

  clock_enter();
  time_us = tick_time_us(port_freertos_now());
  time_us += since_tick_us(time_us, PORT_FREERTOS_TIME_US());
  clock_leave();
  return time_us;
}

uint32_t port_task_first_release_us(void)
{
  return tick_time_us(port_freertos_now() + 1u);
}
#else
/* Counts whole ticks. */
uint32_t port_task_time_us(void)
{
  return tick_time_us(port_freertos_now());
}

uint32_t port_task_first_release_us(void)
{
  return port_task_time_us();
}
#endif

/* Returns the ticks that last at least as long as it takes until `time_us`; 0: it has passed. */
static TickType_t ticks_until(uint32_t time_us)
{
  const uint32_t left_us = time_us - port_task_time_us();

  return left_us > (uint32_t)INT32_MAX
           ? 0u
           : (TickType_t)(((uint64_t)left_us * (uint64_t)configTICK_RATE_HZ + us_per_s - 1u) / us_per_s);
}

/* The kernel counts from a tick that was read before the time, so nothing that passes meanwhile makes the sleep longer.
 * Where a timer of the hardware counts, the first sleep can end within the last tick before the time. */
void port_task_sleep_until(uint32_t time_us)
{
  TickType_t wake = xTaskGetTickCount();
  TickType_t ticks = ticks_until(time_us);

  while (ticks != 0u) {
    (void)xTaskDelayUntil(&wake, ticks); /* false: it did not have to wait */
    wake = xTaskGetTickCount();
    ticks = ticks_until(time_us);
  }
}

uint32_t port_task_stack_peak(uint8_t task)
{
  const kernel_task_t * place = &kernel_tasks[task];

  return place->handle == NULL
           ? 0u
           : place->setting->stack_size -
               (uint32_t)uxTaskGetStackHighWaterMark(place->handle) * (uint32_t)sizeof(StackType_t);
}
