/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Memory of messages comes from the pools of the plan; if those have none, from the arena if it exists. The blocks of
 * every pool are separate objects, so that the linker drops unused ones. */
#include "microros/message_pools.h"

#include "microros/arena.h"
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/message_memory.h"
#include "std_srvs/srv/detail/set_bool__struct.h"
#include "microros_config.h"
#include "rcutils/allocator.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static bool block_is_taken(const microros_blocks_t * blocks, uint32_t block)
{
  return ((uint32_t)blocks->taken[block / 8u] & (1u << (block % 8u))) != 0u;
}

static void block_turn(const microros_blocks_t * blocks, uint32_t block)
{
  blocks->taken[block / 8u] = (uint8_t)(blocks->taken[block / 8u] ^ (1u << (block % 8u)));
}

static uint8_t * block_memory(const microros_blocks_t * blocks, uint32_t block)
{
  return &blocks->memory[(size_t)block * blocks->size];
}

/* Returns the smallest kind of blocks with `size` bytes, or NULL. */
static const microros_blocks_t * pool_blocks(const microros_pool_t * pool, size_t size)
{
  for (uint32_t i = 0; pool != NULL && i < pool->count; ++i) {
    if (pool->blocks[i].size >= size) {
      return &pool->blocks[i];
    }
  }
  return NULL;
}

/* Returns the blocks that contain `memory`, with its index in *block; NULL if it is not a block in use. */
static const microros_blocks_t * pool_find(
  const microros_pool_t * pool, const void * memory, uint32_t * block)
{
  for (uint32_t i = 0; pool != NULL && i < pool->count; ++i) {
    const microros_blocks_t * blocks = &pool->blocks[i];

    for (*block = 0; *block < blocks->count; ++*block) {
      if (block_memory(blocks, *block) == memory) {
        return block_is_taken(blocks, *block) ? blocks : NULL;
      }
    }
  }
  return NULL;
}

static void * blocks_take(const microros_blocks_t * blocks)
{
  for (uint32_t block = 0; block < blocks->count; ++block) {
    if (!block_is_taken(blocks, block)) {
      block_turn(blocks, block);
      (void)memset(block_memory(blocks, block), 0, (size_t)blocks->size);
      return block_memory(blocks, block);
    }
  }
  return NULL;
}

static void * pool_take(const microros_pool_t * pool, size_t * size)
{
  const microros_blocks_t * blocks = pool_blocks(pool, *size);
  void * memory = NULL;

  if (blocks == NULL) {
    const uint32_t most = pool == NULL ? 0u : pool->blocks[pool->count - 1u].size;

    microros_error_set(microros_error_block_large, NULL, NULL, (uint32_t)*size, most);
    return NULL;
  }
  microros_lock();
  memory = blocks_take(blocks);
  microros_unlock();
  if (memory == NULL) {
    microros_error_set(
      microros_error_blocks_taken, NULL, NULL, blocks->size, (uint32_t)MICROROS_KEPT_MESSAGES + 1u);
  }
  *size = (size_t)blocks->size;
  return memory;
}

static void * allocator_take(const rcutils_allocator_t * allocator, size_t size)
{
  void * memory = allocator->allocate(size, allocator->state);

  if (memory != NULL) {
    (void)memset(memory, 0, size);
  }
  return memory;
}

void * microros_memory_take(const microros_pool_t * pool, size_t * size)
{
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  const bool is_default = allocator.allocate == microros_arena_allocate;
  void * memory = is_default ? pool_take(pool, size) : NULL;

  if (memory == NULL && (!is_default || MICROROS_ARENA_SIZE != 0u)) {
    memory = allocator_take(&allocator, *size);
  }
  if (memory == NULL) {
    microros_memory_refuse();
  }
  return memory;
}

size_t microros_memory_room(const microros_pool_t * pool, const void * memory)
{
  const microros_blocks_t * blocks;
  uint32_t block;

  microros_lock();
  blocks = pool_find(pool, memory, &block);
  microros_unlock();
  return blocks == NULL ? 0u : (size_t)blocks->size;
}

void microros_memory_give_back(const microros_pool_t * pool, void * memory)
{
  const microros_blocks_t * blocks;
  uint32_t block;

  if (memory == NULL) {
    return;
  }
  microros_lock();
  blocks = pool_find(pool, memory, &block);
  if (blocks != NULL) {
    block_turn(blocks, block);
  }
  microros_unlock();
  if (blocks == NULL) {
    const rcutils_allocator_t allocator = rcutils_get_default_allocator();

    allocator.deallocate(memory, allocator.state);
  }
}

static std_srvs__srv__SetBool_Request std_srvs__srv__SetBool_Request__message_blocks_0[1][1];
static uint8_t std_srvs__srv__SetBool_Request__message_taken_0[1];
static const microros_blocks_t std_srvs__srv__SetBool_Request__message_blocks[] = {
  {(uint8_t *)std_srvs__srv__SetBool_Request__message_blocks_0, std_srvs__srv__SetBool_Request__message_taken_0,
   (uint32_t)sizeof(std_srvs__srv__SetBool_Request__message_blocks_0[0]), 1u},
};
const microros_pool_t microros_pool_std_srvs__srv__SetBool_Request__message = {std_srvs__srv__SetBool_Request__message_blocks, 1u};

static std_srvs__srv__SetBool_Response std_srvs__srv__SetBool_Response__message_blocks_0[1][1];
static uint8_t std_srvs__srv__SetBool_Response__message_taken_0[1];
static const microros_blocks_t std_srvs__srv__SetBool_Response__message_blocks[] = {
  {(uint8_t *)std_srvs__srv__SetBool_Response__message_blocks_0, std_srvs__srv__SetBool_Response__message_taken_0,
   (uint32_t)sizeof(std_srvs__srv__SetBool_Response__message_blocks_0[0]), 1u},
};
const microros_pool_t microros_pool_std_srvs__srv__SetBool_Response__message = {std_srvs__srv__SetBool_Response__message_blocks, 1u};

static char text_blocks_0[1][21];
static uint8_t text_taken_0[1];
static const microros_blocks_t text_blocks[] = {
  {(uint8_t *)text_blocks_0, text_taken_0,
   (uint32_t)sizeof(text_blocks_0[0]), 1u},
};
const microros_pool_t microros_pool_text = {text_blocks, 1u};
