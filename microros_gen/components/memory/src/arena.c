/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/arena.h"

#include "microros/error.h"
#include "microros_config.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* What every type can be aligned to; blocks begin with one, so the memory behind is aligned. */
typedef union arena_unit_t {
  struct {
    uint32_t units; /* of the whole block, this one included; 0: never used arena */
    bool taken;
  } block;
  uint64_t integer;
  double number;
  void * pointer;
} arena_unit_t;

enum { UNIT = sizeof(arena_unit_t), UNITS = MICROROS_ARENA_SIZE / sizeof(arena_unit_t) };

static arena_unit_t arena[UNITS > 2 ? UNITS : 2];

/* Returns the block behind, or NULL. */
static arena_unit_t * arena_next(arena_unit_t * block)
{
  arena_unit_t * next = block + block->block.units;

  return next < arena + sizeof(arena) / sizeof(arena[0]) ? next : NULL;
}

static void arena_join(arena_unit_t * block)
{
  arena_unit_t * next = arena_next(block);

  while (next != NULL && !next->block.taken) {
    block->block.units += next->block.units;
    next = arena_next(block);
  }
}

static void arena_take(arena_unit_t * block, uint32_t units)
{
  if (block->block.units > units + 1u) {
    arena_unit_t * rest = block + units;

    rest->block.units = block->block.units - units;
    rest->block.taken = false;
    block->block.units = units;
  }
  block->block.taken = true;
}

/* Returns the block of memory that was taken and not given back, or NULL. */
static arena_unit_t * arena_find(const void * pointer)
{
  for (arena_unit_t * block = arena; block != NULL && block->block.units != 0u; block = arena_next(block)) {
    if (block + 1 == pointer) {
      return block->block.taken ? block : NULL;
    }
  }
  return NULL;
}

static uint32_t arena_units(size_t size)
{
  return size > sizeof(arena) ? UINT32_MAX : (uint32_t)(1u + (size + UNIT - 1u) / UNIT);
}

void * microros_arena_allocate(size_t size, void * state)
{
  const uint32_t units = arena_units(size == 0u ? 1u : size);

  (void)state;
  if (arena[0].block.units == 0u) {
    arena[0].block.units = sizeof(arena) / sizeof(arena[0]);
  }
  for (arena_unit_t * block = arena; block != NULL; block = arena_next(block)) {
    if (block->block.taken) {
      continue;
    }
    arena_join(block);
    if (block->block.units >= units) {
      arena_take(block, units);
      return block + 1;
    }
  }
  microros_error_set(
    microros_error_arena, NULL, NULL, (uint32_t)size,
    (uint32_t)(MICROROS_ARENA_SIZE + size + (size_t)2u * UNIT));
  return NULL;
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

void * microros_arena_reallocate(void * pointer, size_t size, void * state)
{
  arena_unit_t * block = arena_find(pointer);
  const uint32_t units = arena_units(size == 0u ? 1u : size);
  void * memory;

  if (block == NULL) {
    return microros_arena_allocate(size, state);
  }
  arena_join(block);
  if (block->block.units >= units) {
    arena_take(block, units);
    return pointer;
  }
  memory = microros_arena_allocate(size, state);
  if (memory != NULL) {
    (void)memcpy(memory, pointer, (block->block.units - 1u) * (size_t)UNIT);
    microros_arena_deallocate(pointer, state);
  }
  return memory;
}

void microros_arena_deallocate(void * pointer, void * state)
{
  arena_unit_t * block = arena_find(pointer);

  (void)state;
  if (block != NULL) {
    block->block.taken = false;
  }
}
