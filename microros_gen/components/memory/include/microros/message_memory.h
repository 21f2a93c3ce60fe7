/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Memory for the strings and sequences of messages that are sent. It comes from pools of fixed blocks, which the plan
 * sizes from the limits of the declared senders (`memory.messages` of each); a request takes a block of the smallest
 * size that holds it, in time proportional to how many blocks of that size there are. Blocks are neither split nor moved.
 * Under the limits there is always one, whatever the order of requests, as long as no more messages are kept.
 *
 * Without pools (memory.messages is 0, or nothing is sent), and where rcutils_set_default_allocator replaced the default
 * allocator, that one serves the requests. A pool is linked only where a function that takes from it is called. May be
 * called from several threads with the component `multithread`.
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
  uint8_t * taken; /* a bit for each block */
  uint32_t size;   /* of a block, bytes */
  uint32_t count;
} microros_blocks_t;

/* Blocks for elements of one kind, smallest first. */
typedef struct microros_pool_t {
  const microros_blocks_t * blocks;
  uint32_t count;
} microros_pool_t;

/*
 * Returns zeroed memory for *size bytes, aligned for elements of the pool, and sets *size to what it has: as much or
 * more. NULL, with the error text set and counted, where there is none. A NULL `pool` has no blocks.
 */
void * microros_memory_take(const microros_pool_t * pool, size_t * size);

/* Returns how many bytes the block `memory` of the pool has; 0: it is none, or free. */
size_t microros_memory_room(const microros_pool_t * pool, const void * memory);

/* Gives memory back. NULL, and a buffer of the application's, are left alone (the latter: unless it replaced the default
 * allocator, which then gets it). */
void microros_memory_give_back(const microros_pool_t * pool, void * memory);

/* Counts a request that got no memory: rmw_uros_get_refused_memory. */
void microros_memory_refuse(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_MESSAGE_MEMORY_H */
