/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Memory for strings and sequences of sent messages. It comes from pools of fixed blocks, which the plan
 * sizes from the limits of the declared senders (`memory.messages` of each). A request takes a block of
 * the smallest sufficient size, in time proportional to the number of blocks of that size. Blocks are
 * neither split nor moved. Within the limits a block is always available, whatever the order of requests,
 * as long as no more messages are alive.
 *
 * Without pools (memory.messages is 0, or nothing is sent), and if rcutils_set_default_allocator replaced
 * the default allocator, that allocator serves the requests. A pool is linked only if a function that
 * takes from it is called. Thread-safe with the component `multithread`.
 */
#ifndef MICROROS_MESSAGE_MEMORY_H
#define MICROROS_MESSAGE_MEMORY_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Blocks of one size. */
typedef struct microros_blocks_t {
  uint8_t * memory;
  uint8_t * taken; /* one bit per block */
  uint32_t size;   /* of a block, in bytes */
  uint32_t count;
} microros_blocks_t;

/* Blocks for elements of one kind, smallest first. */
typedef struct microros_pool_t {
  const microros_blocks_t * blocks;
  uint32_t count;
} microros_pool_t;

/*
 * Returns zeroed memory for *size bytes, aligned for elements of the pool, and sets *size to its actual
 * size, which may be larger. NULL, with the error text set and counted, if no block is free. A NULL `pool`
 * has no blocks.
 */
void * microros_memory_take(const microros_pool_t * pool, size_t * size);

/* Returns the size of the pool's block `memory` in bytes; 0 if it is not a block or is free. */
size_t microros_memory_room(const microros_pool_t * pool, const void * memory);

/* Frees memory. NULL and a buffer of the application are ignored (the latter unless the application
 * replaced the default allocator, which then gets it). */
void microros_memory_give_back(const microros_pool_t * pool, void * memory);

/* Counts a failed request: rmw_uros_get_refused_memory. */
void microros_memory_refuse(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_MESSAGE_MEMORY_H */
