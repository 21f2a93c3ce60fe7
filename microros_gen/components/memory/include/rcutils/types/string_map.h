/* SPDX-License-Identifier: Apache-2.0 */
/* Strings by name, in memory of the allocator that the map is given. */
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
 * A map, or a key or value, that is NULL is RCUTILS_RET_INVALID_ARGUMENT, a map that is not initialized
 * RCUTILS_RET_STRING_MAP_INVALID; RCUTILS_RET_BAD_ALLOC leaves the map as it was.
 */

rcutils_string_map_t rcutils_get_zero_initialized_string_map(void);

/* Makes room for so many pairs. RCUTILS_RET_STRING_MAP_ALREADY_INIT. */
rcutils_ret_t rcutils_string_map_init(
  rcutils_string_map_t * string_map, size_t initial_capacity, rcutils_allocator_t allocator);

/* Gives everything back; RCUTILS_RET_OK for a map that holds nothing, too. */
rcutils_ret_t rcutils_string_map_fini(rcutils_string_map_t * string_map);

rcutils_ret_t rcutils_string_map_get_capacity(const rcutils_string_map_t * string_map, size_t * capacity);

rcutils_ret_t rcutils_string_map_get_size(const rcutils_string_map_t * string_map, size_t * size);

/* Makes room for `capacity` pairs, or for those that the map has where they are more. */
rcutils_ret_t rcutils_string_map_reserve(rcutils_string_map_t * string_map, size_t capacity);

/* Forgets the pairs, and keeps their room. */
rcutils_ret_t rcutils_string_map_clear(rcutils_string_map_t * string_map);

/* Copies key and value into the map, in the place of the value that the key had. Doubles the room where it must. */
rcutils_ret_t rcutils_string_map_set(rcutils_string_map_t * string_map, const char * key, const char * value);

/* The same without more room: RCUTILS_RET_NOT_ENOUGH_SPACE. */
rcutils_ret_t rcutils_string_map_set_no_resize(
  rcutils_string_map_t * string_map, const char * key, const char * value);

/* RCUTILS_RET_STRING_KEY_NOT_FOUND */
rcutils_ret_t rcutils_string_map_unset(rcutils_string_map_t * string_map, const char * key);

bool rcutils_string_map_key_exists(const rcutils_string_map_t * string_map, const char * key);

/* The same for the first `key_length` bytes. */
bool rcutils_string_map_key_existsn(
  const rcutils_string_map_t * string_map, const char * key, size_t key_length);

/* Return the value, which belongs to the map; NULL: there is none. */
const char * rcutils_string_map_get(const rcutils_string_map_t * string_map, const char * key);
const char * rcutils_string_map_getn(
  const rcutils_string_map_t * string_map, const char * key, size_t key_length);

/* Returns the key behind `key`, which is one that this function has returned, or the first one for NULL; NULL: there is no
 * more. */
const char * rcutils_string_map_get_next_key(const rcutils_string_map_t * string_map, const char * key);

/* Sets in `dst_string_map` everything that the other one has. */
rcutils_ret_t rcutils_string_map_copy(
  const rcutils_string_map_t * src_string_map, rcutils_string_map_t * dst_string_map);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_TYPES_STRING_MAP_H */
