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

/* Makes room for `size` strings, all of them NULL. */
rcutils_ret_t rcutils_string_array_init(
  rcutils_string_array_t * string_array, size_t size, const rcutils_allocator_t * allocator);

/* Gives the strings and the array back; RCUTILS_RET_OK for one that holds nothing, too. */
rcutils_ret_t rcutils_string_array_fini(rcutils_string_array_t * string_array);

/* Gives the order of the first strings that differ in *res, else that of the sizes, as strcmp does. RCUTILS_RET_ERROR for
 * a string that is NULL. */
rcutils_ret_t rcutils_string_array_cmp(
  const rcutils_string_array_t * lhs, const rcutils_string_array_t * rhs, int * res);

/* Strings behind `new_size` are given back, new ones are NULL. With RCUTILS_RET_BAD_ALLOC the array is as it was. */
rcutils_ret_t rcutils_string_array_resize(rcutils_string_array_t * string_array, size_t new_size);

/* For qsort: `lhs` and `rhs` point to strings; NULL comes last. */
int rcutils_string_array_sort_compare(const void * lhs, const void * rhs);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_TYPES_STRING_ARRAY_H */
