/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The allocator that applications of micro_ros_stm32cubemx_utils set as the default. The library does not need it: what
 * an application allocates comes from the arena, `memory: {arena: …}` of microros.yaml, not from a heap.
 */
#include "microros/arena.h"

#include <stddef.h>

void * microros_allocate(size_t size, void * state);
void microros_deallocate(void * pointer, void * state);
void * microros_reallocate(void * pointer, size_t size, void * state);
void * microros_zero_allocate(size_t number_of_elements, size_t size_of_element, void * state);

void * microros_allocate(size_t size, void * state)
{
  return microros_arena_allocate(size, state);
}

void microros_deallocate(void * pointer, void * state)
{
  microros_arena_deallocate(pointer, state);
}

void * microros_reallocate(void * pointer, size_t size, void * state)
{
  return microros_arena_reallocate(pointer, size, state);
}

void * microros_zero_allocate(size_t number_of_elements, size_t size_of_element, void * state)
{
  return microros_arena_zero_allocate(number_of_elements, size_of_element, state);
}
