/* SPDX-License-Identifier: Apache-2.0 */
/* An array of strings that owns them, and knows their allocator. */
#ifndef MICROROS_RCUTILS_TYPES_STRING_ARRAY_H
#define MICROROS_RCUTILS_TYPES_STRING_ARRAY_H

#include <stddef.h>

#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcutils_string_array_s {
  size_t size;
  char ** data;
  rcutils_allocator_t allocator;
} rcutils_string_array_t;

rcutils_string_array_t rcutils_get_zero_initialized_string_array(void);

/* Makes room for `size` strings, all NULL. */
rcutils_ret_t rcutils_string_array_init(
  rcutils_string_array_t * string_array, size_t size, const rcutils_allocator_t * allocator);

/* Frees the strings and the array; returns RCUTILS_RET_OK for an empty one, too. */
rcutils_ret_t rcutils_string_array_fini(rcutils_string_array_t * string_array);

/* Sets *res to the order of the first different strings, as strcmp does, otherwise to that of the sizes.
 * RCUTILS_RET_ERROR for a NULL string. */
rcutils_ret_t rcutils_string_array_cmp(
  const rcutils_string_array_t * lhs, const rcutils_string_array_t * rhs, int * res);

/* Strings beyond `new_size` are freed, new ones are NULL. On RCUTILS_RET_BAD_ALLOC the array is unchanged. */
rcutils_ret_t rcutils_string_array_resize(rcutils_string_array_t * string_array, size_t new_size);

/* For qsort: `lhs` and `rhs` point to strings; NULL comes last. */
int rcutils_string_array_sort_compare(const void * lhs, const void * rhs);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_TYPES_STRING_ARRAY_H */
