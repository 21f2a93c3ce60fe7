/* SPDX-License-Identifier: Apache-2.0 */
/* A kernel in which the task still runs for a while after its entry has returned, as on another processor. */
#include "unit.h"

#include <microros/port_freertos.h>
#include <microros/port_tasks.h>

#include "semphr.h"
#include "task.h"

#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>

enum { TICKS = 3 };

static jmp_buf suspension;
static uint32_t delays;
static bool is_deleted;
static bool is_changed;

TaskHandle_t xTaskCreateStatic(
  TaskFunction_t function, const char * name, configSTACK_DEPTH_TYPE depth, void * argument,
  UBaseType_t priority, StackType_t * stack, StaticTask_t * storage)
{
  (void)name, (void)depth, (void)priority, (void)stack;
  if (setjmp(suspension) == 0) {
    function(argument);
  }
  return (TaskHandle_t)(void *)storage;
}

void vTaskSuspend(TaskHandle_t task)
{
  CHECK(task == NULL);
  longjmp(suspension, 1);
}

void vTaskPrioritySet(TaskHandle_t task, UBaseType_t priority)
{
  CHECK(task != NULL && priority == tskIDLE_PRIORITY + 2u);
  is_changed = true;
}

void vTaskDelay(TickType_t ticks)
{
  delays += ticks;
}

#if KERNEL_CORES > 1
eTaskState eTaskGetState(TaskHandle_t task)
{
  CHECK(task != NULL);
  return delays < (uint32_t)TICKS ? eRunning : eSuspended;
}
#endif

void vTaskDelete(TaskHandle_t task)
{
  CHECK(task != NULL);
  CHECK(delays == (KERNEL_CORES > 1 ? (uint32_t)TICKS : 0u));
  is_deleted = true;
}

SemaphoreHandle_t xSemaphoreCreateBinaryStatic(StaticSemaphore_t * storage)
{
  return (SemaphoreHandle_t)(void *)storage;
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

BaseType_t xTaskDelayUntil(TickType_t * previous, TickType_t increment)
{
  (void)previous, (void)increment;
  return pdTRUE;
}

TickType_t xTaskGetTickCount(void)
{
  return 0;
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

void vTaskSuspendAll(void)
{
}

BaseType_t xTaskResumeAll(void)
{
  return pdTRUE;
}

uint64_t port_freertos_now(void)
{
  return 0;
}

TickType_t port_freertos_ticks(uint32_t duration_ms)
{
  return duration_ms;
}

static void entry(uint8_t task)
{
  CHECK(task == 0u);
}

int main(void)
{
  static uint64_t stack[64];
  static const port_task_t setting = {"task", entry, stack, sizeof(stack), 1};

  CHECK(port_task_create(0, &setting));
  CHECK(port_task_set_priority(0, 2) && is_changed);
  port_task_join(0);
  CHECK(is_deleted);
  return 0;
}
