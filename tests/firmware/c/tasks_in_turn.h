/* SPDX-License-Identifier: Apache-2.0 */
/* What tasks ask of the port, and needs nothing of it where they run one after the other in a program. */
#ifndef TASKS_IN_TURN_H
#define TASKS_IN_TURN_H

#include <microros/port.h>
#include <microros/port_tasks.h>

void port_task_join(uint8_t task)
{
  (void)task;
}

void port_task_set(uint8_t task)
{
  (void)task;
}

uint32_t port_task_time_us(void)
{
  return port_time_ms() * 1000u;
}

uint32_t port_task_first_release_us(void)
{
  return port_task_time_us();
}

#endif /* TASKS_IN_TURN_H */
