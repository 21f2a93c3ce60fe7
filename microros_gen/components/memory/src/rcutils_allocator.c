/* SPDX-License-Identifier: Apache-2.0 */
#include "rcutils/allocator.h"

#include "microros/arena.h"

#include <string.h>

/* Returns the allocator set by rcutils_set_default_allocator: one for all, since the getter takes no
 * handle. Not linked if no one sets it. */
static const rcutils_allocator_t ** allocator_chosen(void)
{
  static const rcutils_allocator_t * chosen;

  return &chosen;
}

rcutils_allocator_t rcutils_get_zero_initialized_allocator(void)
{
  rcutils_allocator_t allocator;

  (void)memset(&allocator, 0, sizeof(allocator));
  return allocator;
}

rcutils_allocator_t rcutils_get_default_allocator(void)
{
  const rcutils_allocator_t arena = {
    microros_arena_allocate, microros_arena_deallocate, microros_arena_reallocate,
    microros_arena_zero_allocate, NULL};

  const rcutils_allocator_t * chosen = *allocator_chosen();

  return chosen != NULL ? *chosen : arena;
}

bool rcutils_set_default_allocator(rcutils_allocator_t * allocator)
{
  static rcutils_allocator_t kept;

  if (!rcutils_allocator_is_valid(allocator)) {
    return false;
  }
  kept = *allocator;
  *allocator_chosen() = &kept;
  return true;
}

bool rcutils_allocator_is_valid(const rcutils_allocator_t * allocator)
{
  return allocator != NULL && allocator->allocate != NULL && allocator->deallocate != NULL &&
         allocator->reallocate != NULL && allocator->zero_allocate != NULL;
}

void * rcutils_reallocf(void * pointer, size_t size, rcutils_allocator_t * allocator)
{
  void * memory;

  if (!rcutils_allocator_is_valid(allocator)) {
    return NULL;
  }
  memory = allocator->reallocate(pointer, size, allocator->state);
  if (memory == NULL) {
    allocator->deallocate(pointer, allocator->state);
  }
  return memory;
}
