/* SPDX-License-Identifier: Apache-2.0 */
/* Strings by name, in memory of the map's allocator. */
#ifndef MICROROS_RCUTILS_TYPES_STRING_MAP_H
#define MICROROS_RCUTILS_TYPES_STRING_MAP_H

#include <stdbool.h>
#include <stddef.h>

#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

struct rcutils_string_map_impl_s;

typedef struct rcutils_string_map_s {
  struct rcutils_string_map_impl_s * impl; /* NULL: not initialized */
} rcutils_string_map_t;

/*
 * RCUTILS_RET_INVALID_ARGUMENT for a NULL map, key or value, RCUTILS_RET_STRING_MAP_INVALID for a map that is
 * not initialized; RCUTILS_RET_BAD_ALLOC leaves the map unchanged.
 */

rcutils_string_map_t rcutils_get_zero_initialized_string_map(void);

/* Makes room for `initial_capacity` pairs. RCUTILS_RET_STRING_MAP_ALREADY_INIT. */
rcutils_ret_t rcutils_string_map_init(
  rcutils_string_map_t * string_map, size_t initial_capacity, rcutils_allocator_t allocator);

/* Frees all memory; returns RCUTILS_RET_OK for an empty map, too. */
rcutils_ret_t rcutils_string_map_fini(rcutils_string_map_t * string_map);

rcutils_ret_t rcutils_string_map_get_capacity(const rcutils_string_map_t * string_map, size_t * capacity);

rcutils_ret_t rcutils_string_map_get_size(const rcutils_string_map_t * string_map, size_t * size);

/* Changes the capacity to `capacity` pairs, at least the number of existing ones. */
rcutils_ret_t rcutils_string_map_reserve(rcutils_string_map_t * string_map, size_t capacity);

/* Removes the pairs and keeps the capacity. */
rcutils_ret_t rcutils_string_map_clear(rcutils_string_map_t * string_map);

/* Copies key and value into the map; replaces an existing value. Doubles the capacity if needed. */
rcutils_ret_t rcutils_string_map_set(rcutils_string_map_t * string_map, const char * key, const char * value);

/* Same without growing: RCUTILS_RET_NOT_ENOUGH_SPACE. */
rcutils_ret_t rcutils_string_map_set_no_resize(
  rcutils_string_map_t * string_map, const char * key, const char * value);

/* RCUTILS_RET_STRING_KEY_NOT_FOUND for an unknown key. */
rcutils_ret_t rcutils_string_map_unset(rcutils_string_map_t * string_map, const char * key);

bool rcutils_string_map_key_exists(const rcutils_string_map_t * string_map, const char * key);

/* Same for the first `key_length` bytes. */
bool rcutils_string_map_key_existsn(
  const rcutils_string_map_t * string_map, const char * key, size_t key_length);

/* Return the value, which belongs to the map; NULL for an unknown key. */
const char * rcutils_string_map_get(const rcutils_string_map_t * string_map, const char * key);
const char * rcutils_string_map_getn(
  const rcutils_string_map_t * string_map, const char * key, size_t key_length);

/* Returns the key after `key`, which must be a result of this function, or the first one for NULL; NULL at the
 * end. */
const char * rcutils_string_map_get_next_key(const rcutils_string_map_t * string_map, const char * key);

/* Copies all pairs of the other map to `dst_string_map`. */
rcutils_ret_t rcutils_string_map_copy(
  const rcutils_string_map_t * src_string_map, rcutils_string_map_t * dst_string_map);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_TYPES_STRING_MAP_H */
