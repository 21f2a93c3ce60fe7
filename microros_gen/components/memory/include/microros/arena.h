/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Memory of the default allocator: `memory.arena` bytes, first fit, adjacent free blocks are merged. Every
 * call walks the blocks at most once. Pointers from elsewhere are ignored when freed. Not thread-safe.
 */
#ifndef MICROROS_ARENA_H
#define MICROROS_ARENA_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Each returns NULL, and sets the error text, if there is no room. Memory is aligned for every type. */
void * microros_arena_allocate(size_t size, void * state);
void * microros_arena_zero_allocate(size_t number_of_elements, size_t size_of_element, void * state);

/* A `pointer` from elsewhere counts as NULL: its size is unknown, so nothing is copied. */
void * microros_arena_reallocate(void * pointer, size_t size, void * state);

void microros_arena_deallocate(void * pointer, void * state);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ARENA_H */
