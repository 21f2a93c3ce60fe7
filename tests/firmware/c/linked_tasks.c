/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The functions of the port that the board of tests/support/firmware/tasks.py does not have, so that an example of the
 * tool, which is included before this, can be linked with tasks. What follows from its code alone needs no run. */
#include "tasks_in_turn.h"

#include <microros/port.h>
#include <microros/port_tasks.h>

#include <stddef.h>

void port_lock(void)
{
}

void port_unlock(void)
{
}

void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  (void)handle;
  (void)timeout_ms;
}

void port_wake(void)
{
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  (void)host;
  (void)port;
  return udp != NULL;
}

void port_udp_close(port_udp_t * udp)
{
  (void)udp;
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  (void)data;
  return udp != NULL && size != 0u;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  (void)buffer;
  return udp == NULL ? (int32_t)capacity : 0;
}

bool port_task_create(uint8_t task, const port_task_t * setting)
{
  (void)task;
  return setting != NULL;
}

uint8_t port_task_self(void)
{
  return PORT_TASK_NONE;
}

bool port_task_has_priorities(void)
{
  return true;
}

bool port_task_set_priority(uint8_t task, uint8_t priority)
{
  return task != priority;
}

void port_task_wait(uint8_t task, uint32_t timeout_ms)
{
  (void)task;
  (void)timeout_ms;
}

void port_task_sleep_until(uint32_t time_us)
{
  (void)time_us;
}

uint32_t port_task_stack_peak(uint8_t task)
{
  return task;
}
