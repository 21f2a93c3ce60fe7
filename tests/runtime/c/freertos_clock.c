/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A kernel with ticks of 1 ms and a timer of microseconds, both simulated. A task runs 3 to 25 us after the tick that
 * releases it. Now and then the kernel misses ticks. freertos_clock PHASE TIMER: microseconds after a tick at which the task starts, and what the timer shows then.
 */
#include "unit.h"

#include <microros/port_freertos.h>
#include <microros/port_tasks.h>

#include "semphr.h"
#include "task.h"

#include <stddef.h>
#include <stdlib.h>

enum {
  TICK_US = 1000,
  RUNS = 5000,
  LEAST_US = 3,
  MOST_US = 25,
  WORK_US = 300,
  STALL_RUNS = 100,
  STALL_US = 50000
};

static uint64_t true_us;
static uint64_t lost_us; /* the ticks that the kernel has missed */
static uint32_t timer_lead;
static uint32_t suspended;
static uint32_t woken;

uint32_t kernel_time_us(void)
{
  return (uint32_t)true_us + timer_lead;
}

uint64_t port_freertos_now(void)
{
  return (true_us - lost_us) / TICK_US;
}

TickType_t xTaskGetTickCount(void)
{
  return (TickType_t)port_freertos_now();
}

BaseType_t xTaskDelayUntil(TickType_t * previous, TickType_t increment)
{
  const TickType_t end = *previous + increment;

  CHECK(increment != 0u && suspended == 0u);
  while ((TickType_t)port_freertos_now() != end) {
    true_us += TICK_US - true_us % TICK_US;
  }
  true_us += LEAST_US + (uint64_t)(rand() % (MOST_US - LEAST_US + 1));
  ++woken;
  return pdTRUE;
}

void vTaskSuspendAll(void)
{
  ++suspended;
}

BaseType_t xTaskResumeAll(void)
{
  --suspended;
  return pdTRUE;
}

TickType_t port_freertos_ticks(uint32_t duration_ms)
{
  return duration_ms;
}

/* The rest of what the file calls. */
TaskHandle_t xTaskCreateStatic(
  TaskFunction_t function, const char * name, configSTACK_DEPTH_TYPE depth, void * argument,
  UBaseType_t priority, StackType_t * stack, StaticTask_t * storage)
{
  (void)function, (void)name, (void)depth, (void)argument, (void)priority, (void)stack, (void)storage;
  abort();
}

void vTaskSuspend(TaskHandle_t task)
{
  (void)task;
}

void vTaskPrioritySet(TaskHandle_t task, UBaseType_t priority)
{
  (void)task, (void)priority;
}

void vTaskDelay(TickType_t ticks)
{
  (void)ticks;
}

void vTaskDelete(TaskHandle_t task)
{
  (void)task;
}

SemaphoreHandle_t xSemaphoreCreateBinaryStatic(StaticSemaphore_t * storage)
{
  (void)storage;
  return NULL;
}

BaseType_t xSemaphoreTake(SemaphoreHandle_t semaphore, TickType_t ticks)
{
  (void)semaphore, (void)ticks;
  return pdTRUE;
}

BaseType_t xSemaphoreGive(SemaphoreHandle_t semaphore)
{
  (void)semaphore;
  return pdTRUE;
}

TaskHandle_t xTaskGetCurrentTaskHandle(void)
{
  return NULL;
}

UBaseType_t uxTaskGetStackHighWaterMark(TaskHandle_t task)
{
  (void)task;
  return 0;
}

/* The clock does not go back, and follows the timer. */
static uint32_t time_us(void)
{
  static uint32_t before_us;
  static bool is_begun;
  const uint32_t now_us = port_task_time_us();

  CHECK(!is_begun || now_us - before_us < (uint32_t)INT32_MAX);
  is_begun = true;
  before_us = now_us;
  return now_us;
}

int main(int count, char * arguments[])
{
  uint32_t next_us;

  CHECK(count == 3);
  true_us = (UINT64_C(4294960) * TICK_US) + strtoul(arguments[1], NULL, 10); /* microseconds wrap soon */
  timer_lead = (uint32_t)strtoul(arguments[2], NULL, 10) - (uint32_t)true_us;
  next_us = port_task_first_release_us();
  CHECK(next_us - time_us() <= (uint32_t)TICK_US);
  for (uint32_t run = 1; run <= (uint32_t)RUNS; ++run) {
    port_task_sleep_until(next_us);
    CHECK(woken == run); /* in the next tick, without a further sleep */
    CHECK(true_us % TICK_US <= (uint64_t)MOST_US);
    CHECK(time_us() - next_us <= (uint32_t)MOST_US);
    true_us += WORK_US;
    CHECK(time_us() - next_us >= (uint32_t)WORK_US && time_us() - next_us <= (uint32_t)(WORK_US + MOST_US));
    if (run % (uint32_t)STALL_RUNS == 0u) {
      true_us += (uint64_t)STALL_US;
      lost_us += (uint64_t)STALL_US;
      CHECK(time_us() - next_us < (uint32_t)TICK_US);
    }
    next_us += (uint32_t)TICK_US;
  }
  true_us += (uint64_t)5 * TICK_US; /* a time that has passed */
  port_task_sleep_until(next_us);
  CHECK(woken == (uint32_t)RUNS && suspended == 0u);
  return 0;
}
