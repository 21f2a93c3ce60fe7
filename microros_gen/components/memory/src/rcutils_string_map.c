/* SPDX-License-Identifier: Apache-2.0 */
/* Pairs are in the order in which they were set; the last one takes the place of a removed one. */
#include "rcutils/types/string_map.h"

#include <stdint.h>
#include <string.h>

typedef struct map_pair_t {
  char * key;
  char * value;
} map_pair_t;

struct rcutils_string_map_impl_s {
  map_pair_t * pairs;
  size_t capacity;
  size_t size;
  rcutils_allocator_t allocator;
};

typedef struct rcutils_string_map_impl_s map_t;

rcutils_string_map_t rcutils_get_zero_initialized_string_map(void)
{
  const rcutils_string_map_t map = {NULL};

  return map;
}

static rcutils_ret_t map_check(const rcutils_string_map_t * string_map)
{
  if (string_map == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  return string_map->impl != NULL ? RCUTILS_RET_OK : RCUTILS_RET_STRING_MAP_INVALID;
}

/* Returns the pair of a key, or NULL. */
static map_pair_t * map_find(const map_t * map, const char * key, size_t size)
{
  for (size_t i = 0; i < map->size; ++i) {
    if (strncmp(map->pairs[i].key, key, size) == 0 && map->pairs[i].key[size] == '\0') {
      return &map->pairs[i];
    }
  }
  return NULL;
}

static void map_release(const map_t * map, const map_pair_t * pair)
{
  map->allocator.deallocate(pair->key, map->allocator.state);
  map->allocator.deallocate(pair->value, map->allocator.state);
}

static char * map_copy_text(const map_t * map, const char * text)
{
  const size_t size = strlen(text) + 1u;
  char * copy = map->allocator.allocate(size, map->allocator.state);

  if (copy != NULL) {
    (void)memcpy(copy, text, size);
  }
  return copy;
}

static rcutils_ret_t map_reserve(map_t * map, size_t capacity)
{
  const rcutils_allocator_t * allocator = &map->allocator;
  const size_t room = capacity < map->size ? map->size : capacity;
  map_pair_t * pairs = NULL;

  if (room == map->capacity) {
    return RCUTILS_RET_OK;
  }
  if (room == 0u) {
    allocator->deallocate(map->pairs, allocator->state);
  } else {
    if (room <= SIZE_MAX / sizeof(*pairs)) {
      pairs = allocator->reallocate(map->pairs, room * sizeof(*pairs), allocator->state);
    }
    if (pairs == NULL) {
      return RCUTILS_RET_BAD_ALLOC;
    }
  }
  map->pairs = pairs;
  map->capacity = room;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_map_init(
  rcutils_string_map_t * string_map, size_t initial_capacity, rcutils_allocator_t allocator)
{
  map_t * map;
  rcutils_ret_t result;

  if (string_map == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  if (string_map->impl != NULL) {
    return RCUTILS_RET_STRING_MAP_ALREADY_INIT;
  }
  if (!rcutils_allocator_is_valid(&allocator)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  map = allocator.allocate(sizeof(*map), allocator.state);
  if (map == NULL) {
    return RCUTILS_RET_BAD_ALLOC;
  }
  (void)memset(map, 0, sizeof(*map));
  map->allocator = allocator;
  result = map_reserve(map, initial_capacity);
  if (result != RCUTILS_RET_OK) {
    allocator.deallocate(map, allocator.state);
    return result;
  }
  string_map->impl = map;
  return RCUTILS_RET_OK;
}

static void map_clear(map_t * map)
{
  for (size_t i = 0; i < map->size; ++i) {
    map_release(map, &map->pairs[i]);
  }
  map->size = 0;
}

rcutils_ret_t rcutils_string_map_fini(rcutils_string_map_t * string_map)
{
  map_t * map;

  if (string_map == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  map = string_map->impl;
  if (map != NULL) {
    const rcutils_allocator_t allocator = map->allocator;

    map_clear(map);
    allocator.deallocate(map->pairs, allocator.state);
    allocator.deallocate(map, allocator.state);
    string_map->impl = NULL;
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_map_get_capacity(const rcutils_string_map_t * string_map, size_t * capacity)
{
  const rcutils_ret_t result = map_check(string_map);

  if (result != RCUTILS_RET_OK) {
    return result;
  }
  if (capacity == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  *capacity = string_map->impl->capacity;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_map_get_size(const rcutils_string_map_t * string_map, size_t * size)
{
  const rcutils_ret_t result = map_check(string_map);

  if (result != RCUTILS_RET_OK) {
    return result;
  }
  if (size == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  *size = string_map->impl->size;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_map_reserve(rcutils_string_map_t * string_map, size_t capacity)
{
  const rcutils_ret_t result = map_check(string_map);

  return result == RCUTILS_RET_OK ? map_reserve(string_map->impl, capacity) : result;
}

rcutils_ret_t rcutils_string_map_clear(rcutils_string_map_t * string_map)
{
  const rcutils_ret_t result = map_check(string_map);

  if (result == RCUTILS_RET_OK) {
    map_clear(string_map->impl);
  }
  return result;
}

/* Appends a pair; there is room. The map already owns `value`. */
static rcutils_ret_t map_append(map_t * map, const char * key, char * value)
{
  const map_pair_t pair = {map_copy_text(map, key), value};

  if (pair.key == NULL) {
    return RCUTILS_RET_BAD_ALLOC;
  }
  map->pairs[map->size] = pair;
  ++map->size;
  return RCUTILS_RET_OK;
}

static rcutils_ret_t map_set(map_t * map, const char * key, const char * value)
{
  map_pair_t * pair = map_find(map, key, strlen(key));
  rcutils_ret_t result = RCUTILS_RET_OK;
  char * copy;

  if (pair == NULL && map->size == map->capacity) {
    return RCUTILS_RET_NOT_ENOUGH_SPACE;
  }
  copy = map_copy_text(map, value);
  if (copy == NULL) {
    return RCUTILS_RET_BAD_ALLOC;
  }
  if (pair != NULL) {
    map->allocator.deallocate(pair->value, map->allocator.state);
    pair->value = copy;
    return RCUTILS_RET_OK;
  }
  result = map_append(map, key, copy);
  if (result != RCUTILS_RET_OK) {
    map->allocator.deallocate(copy, map->allocator.state);
  }
  return result;
}

rcutils_ret_t rcutils_string_map_set_no_resize(
  rcutils_string_map_t * string_map, const char * key, const char * value)
{
  const rcutils_ret_t result = map_check(string_map);

  if (result != RCUTILS_RET_OK) {
    return result;
  }
  return key != NULL && value != NULL ? map_set(string_map->impl, key, value) : RCUTILS_RET_INVALID_ARGUMENT;
}

rcutils_ret_t rcutils_string_map_set(rcutils_string_map_t * string_map, const char * key, const char * value)
{
  rcutils_ret_t result = rcutils_string_map_set_no_resize(string_map, key, value);

  if (result == RCUTILS_RET_NOT_ENOUGH_SPACE) {
    map_t * map = string_map->impl;

    result = map_reserve(map, map->capacity != 0u ? 2u * map->capacity : 1u);
    if (result == RCUTILS_RET_OK) {
      result = map_set(map, key, value);
    }
  }
  return result;
}

rcutils_ret_t rcutils_string_map_unset(rcutils_string_map_t * string_map, const char * key)
{
  const rcutils_ret_t result = map_check(string_map);
  map_pair_t * pair;
  map_t * map;

  if (result != RCUTILS_RET_OK) {
    return result;
  }
  if (key == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  map = string_map->impl;
  pair = map_find(map, key, strlen(key));
  if (pair == NULL) {
    return RCUTILS_RET_STRING_KEY_NOT_FOUND;
  }
  map_release(map, pair);
  --map->size;
  *pair = map->pairs[map->size];
  return RCUTILS_RET_OK;
}

const char * rcutils_string_map_getn(
  const rcutils_string_map_t * string_map, const char * key, size_t key_length)
{
  const map_pair_t * pair = NULL;

  if (map_check(string_map) == RCUTILS_RET_OK && key != NULL) {
    pair = map_find(string_map->impl, key, key_length);
  }
  return pair != NULL ? pair->value : NULL;
}

const char * rcutils_string_map_get(const rcutils_string_map_t * string_map, const char * key)
{
  return key != NULL ? rcutils_string_map_getn(string_map, key, strlen(key)) : NULL;
}

bool rcutils_string_map_key_existsn(
  const rcutils_string_map_t * string_map, const char * key, size_t key_length)
{
  return rcutils_string_map_getn(string_map, key, key_length) != NULL;
}

bool rcutils_string_map_key_exists(const rcutils_string_map_t * string_map, const char * key)
{
  return rcutils_string_map_get(string_map, key) != NULL;
}

const char * rcutils_string_map_get_next_key(const rcutils_string_map_t * string_map, const char * key)
{
  const map_t * map;
  size_t next = 0;

  if (map_check(string_map) != RCUTILS_RET_OK) {
    return NULL;
  }
  map = string_map->impl;
  if (key != NULL) {
    while (next < map->size && map->pairs[next].key != key) {
      ++next;
    }
    ++next;
  }
  return next < map->size ? map->pairs[next].key : NULL;
}

rcutils_ret_t rcutils_string_map_copy(
  const rcutils_string_map_t * src_string_map, rcutils_string_map_t * dst_string_map)
{
  rcutils_ret_t result = map_check(src_string_map);

  if (result == RCUTILS_RET_OK) {
    result = map_check(dst_string_map);
  }
  for (size_t i = 0; result == RCUTILS_RET_OK && i < src_string_map->impl->size; ++i) {
    const map_pair_t * pair = &src_string_map->impl->pairs[i];

    result = rcutils_string_map_set(dst_string_map, pair->key, pair->value);
  }
  return result;
}
