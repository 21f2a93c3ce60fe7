/* SPDX-License-Identifier: Apache-2.0 */
/* memory.arena is 0: every allocation fails with an error text that names the key. */
#include "microros/arena.h"

#include "microros/error.h"

#include <stdint.h>

void * microros_arena_allocate(size_t size, void * state)
{
  (void)state;
  microros_error_set(microros_error_arena, NULL, NULL, (uint32_t)size, (uint32_t)size + 32u);
  return NULL;
}

void * microros_arena_zero_allocate(size_t number_of_elements, size_t size_of_element, void * state)
{
  return microros_arena_allocate(number_of_elements * size_of_element, state);
}

void * microros_arena_reallocate(void * pointer, size_t size, void * state)
{
  (void)pointer;
  return microros_arena_allocate(size, state);
}

void microros_arena_deallocate(void * pointer, void * state)
{
  (void)pointer;
  (void)state;
}
