/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/arena.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros_config.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { UNIT = sizeof(uint64_t), UNITS = MICROROS_ARENA_SIZE / UNIT > 2 ? MICROROS_ARENA_SIZE / UNIT : 2 };

/* Consecutive blocks. A block is identified by the index of its first word, its header; the memory after
 * it is aligned for every type. A header is the number of words including itself, times two, plus one if
 * the block is in use; 0: the arena was never used. */
static uint64_t arena[UNITS];

static uint32_t arena_units(uint32_t block)
{
  return (uint32_t)arena[block] / 2u;
}

static bool arena_is_taken(uint32_t block)
{
  return ((uint32_t)arena[block] & 1u) != 0u;
}

static void arena_set(uint32_t block, uint32_t units, bool taken)
{
  const uint32_t head = units * 2u + (taken ? 1u : 0u);

  arena[block] = head;
}

/* Merges a block with the free ones after it. */
static void arena_join(uint32_t block)
{
  uint32_t next = block + arena_units(block);

  while (next < UNITS && !arena_is_taken(next)) {
    next += arena_units(next);
  }
  arena_set(block, next - block, arena_is_taken(block));
}

/* Takes the first `units` words of a block; the rest becomes another block. */
static void arena_take(uint32_t block, uint32_t units)
{
  const uint32_t all = arena_units(block);

  if (all > units + 1u) {
    arena_set(block + units, all - units, false);
    arena_set(block, units, true);
  } else {
    arena_set(block, all, true);
  }
}

/* Returns the block of memory in use, or UNITS. */
static uint32_t arena_find(const void * pointer)
{
  uint32_t block = 0;

  while (block < UNITS && arena[block] != 0u) {
    if (&arena[block + 1u] == pointer) {
      return arena_is_taken(block) ? block : (uint32_t)UNITS;
    }
    block += arena_units(block);
  }
  return UNITS;
}

/* Returns the number of words of a block for `size` bytes; more than UNITS if that is impossible. */
static uint32_t arena_needed(size_t size)
{
  return size > sizeof(arena) ? UNITS + 1u : (uint32_t)(1u + (size + UNIT - 1u) / UNIT);
}

static void * arena_allocate(size_t size)
{
  const uint32_t units = arena_needed(size == 0u ? 1u : size);

  if (arena[0] == 0u) {
    arena_set(0, UNITS, false);
  }
  for (uint32_t block = 0; block < UNITS; block += arena_units(block)) {
    if (arena_is_taken(block)) {
      continue;
    }
    arena_join(block);
    if (arena_units(block) >= units) {
      arena_take(block, units);
      return &arena[block + 1u];
    }
  }
  microros_error_set(
    microros_error_arena, NULL, NULL, (uint32_t)size,
    (uint32_t)(MICROROS_ARENA_SIZE + size + (size_t)2u * UNIT));
  return NULL;
}

void * microros_arena_allocate(size_t size, void * state)
{
  void * memory;

  (void)state;
  microros_lock();
  memory = arena_allocate(size);
  microros_unlock();
  return memory;
}

void * microros_arena_zero_allocate(size_t number_of_elements, size_t size_of_element, void * state)
{
  const bool overflows = size_of_element != 0u && number_of_elements > SIZE_MAX / size_of_element;
  const size_t size = overflows ? SIZE_MAX : number_of_elements * size_of_element;
  void * memory = microros_arena_allocate(size, state);

  if (memory != NULL) {
    (void)memset(memory, 0, size);
  }
  return memory;
}

static void * arena_reallocate(void * pointer, size_t size, void * state)
{
  const uint32_t block = arena_find(pointer);
  const uint32_t units = arena_needed(size == 0u ? 1u : size);
  void * memory;

  if (block == UNITS) {
    return microros_arena_allocate(size, state);
  }
  arena_join(block);
  if (arena_units(block) >= units) {
    arena_take(block, units);
    return pointer;
  }
  memory = microros_arena_allocate(size, state);
  if (memory != NULL) {
    (void)memcpy(memory, pointer, ((size_t)arena_units(block) - 1u) * (size_t)UNIT);
    microros_arena_deallocate(pointer, state);
  }
  return memory;
}

void * microros_arena_reallocate(void * pointer, size_t size, void * state)
{
  void * memory;

  microros_lock();
  memory = arena_reallocate(pointer, size, state);
  microros_unlock();
  return memory;
}

void microros_arena_deallocate(void * pointer, void * state)
{
  uint32_t block;

  (void)state;
  microros_lock();
  block = arena_find(pointer);
  if (block != UNITS) {
    arena_set(block, arena_units(block), false);
  }
  microros_unlock();
}
