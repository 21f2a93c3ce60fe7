/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/message_memory.h"

#include "microros/lock.h"
#include "microros/message_memory.h"

/* One counter for all, since functions of messages take no handle. */
static uint32_t memory_refused;

void microros_memory_refuse(void)
{
  microros_lock();
  memory_refused += memory_refused != UINT32_MAX ? 1u : 0u;
  microros_unlock();
}

uint32_t rmw_uros_get_refused_memory(void)
{
  uint32_t count;

  microros_lock();
  count = memory_refused;
  microros_unlock();
  return count;
}
