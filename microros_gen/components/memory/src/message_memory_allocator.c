/* SPDX-License-Identifier: Apache-2.0 */
/* No pools: memory of messages comes from the default allocator. */
#include "microros/message_memory.h"
#include "rcutils/allocator.h"

#include <string.h>

void * microros_memory_take(const microros_pool_t * pool, size_t * size)
{
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  void * memory = allocator.allocate(*size, allocator.state);

  (void)pool;
  if (memory == NULL) {
    microros_memory_refuse();
  } else {
    (void)memset(memory, 0, *size);
  }
  return memory;
}

size_t microros_memory_room(const microros_pool_t * pool, const void * memory)
{
  (void)pool;
  (void)memory;
  return 0;
}

void microros_memory_give_back(const microros_pool_t * pool, void * memory)
{
  (void)pool;
  if (memory != NULL) {
    const rcutils_allocator_t allocator = rcutils_get_default_allocator();

    allocator.deallocate(memory, allocator.state);
  }
}
