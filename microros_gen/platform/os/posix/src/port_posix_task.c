/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port_posix_task.h"

#include <sched.h>
#include <string.h>

enum { STACK_FILL = 0xa5 };

int port_posix_task_priority(uint8_t level)
{
  return sched_get_priority_min(SCHED_FIFO) + (int)level;
}

void port_posix_task_fill(void * stack, uint32_t size)
{
  (void)memset(stack, (int)STACK_FILL, size);
}

/* Stacks of the processors with POSIX systems grow towards lower addresses. */
uint32_t port_posix_task_unused(const void * stack, uint32_t size)
{
  const uint8_t * bytes = stack;
  uint32_t unused = 0;

  while (unused < size && bytes[unused] == (uint8_t)STACK_FILL) {
    ++unused;
  }
  return unused;
}
