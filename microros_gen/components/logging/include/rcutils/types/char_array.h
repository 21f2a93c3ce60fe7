/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A text in a buffer that can grow. A buffer of the caller (`owns_buffer` false) is used while the text fits; then memory of
 * the allocator replaces it. Without a text, `buffer_length` is 0; otherwise it counts the NUL.
 *
 * Functions return RCUTILS_RET_BAD_ALLOC if the allocator has no memory, and leave the text as it was
 * (rcutils_char_array_vsprintf: truncated).
 */
#ifndef MICROROS_RCUTILS_TYPES_CHAR_ARRAY_H
#define MICROROS_RCUTILS_TYPES_CHAR_ARRAY_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcutils_char_array_s {
  char * buffer;
  bool owns_buffer;
  size_t buffer_length;
  size_t buffer_capacity;
  rcutils_allocator_t allocator;
} rcutils_char_array_t;

rcutils_char_array_t rcutils_get_zero_initialized_char_array(void);

/* Allocates a buffer of `buffer_capacity` bytes with an empty text; 0 allocates nothing. RCUTILS_RET_ERROR for an invalid
 * allocator. */
rcutils_ret_t rcutils_char_array_init(
  rcutils_char_array_t * char_array, size_t buffer_capacity, const rcutils_allocator_t * allocator);

/* Frees a buffer that the allocator provided. */
rcutils_ret_t rcutils_char_array_fini(rcutils_char_array_t * char_array);

/* Changes the capacity to `new_size`; a smaller one truncates the text, without a NUL. RCUTILS_RET_INVALID_ARGUMENT for 0. */
rcutils_ret_t rcutils_char_array_resize(rcutils_char_array_t * char_array, size_t new_size);

/* Raises the capacity to `new_size` if it is smaller. */
rcutils_ret_t rcutils_char_array_expand_as_needed(rcutils_char_array_t * char_array, size_t new_size);

/* Replaces the text with a formatted one, with the formats of rcutils/logging.h. `args` can be used again. Takes as long as
 * the capacity allows, and up to as long again for each doubling: not with the lock held. */
rcutils_ret_t rcutils_char_array_vsprintf(
  rcutils_char_array_t * char_array, const char * format, va_list args);

/* Appends a string, or at most `n` bytes of it. */
rcutils_ret_t rcutils_char_array_strncat(rcutils_char_array_t * char_array, const char * src, size_t n);
rcutils_ret_t rcutils_char_array_strcat(rcutils_char_array_t * char_array, const char * src);

/* Replaces the content with `n` bytes, or with a string. */
rcutils_ret_t rcutils_char_array_memcpy(rcutils_char_array_t * char_array, const char * src, size_t n);
rcutils_ret_t rcutils_char_array_strcpy(rcutils_char_array_t * char_array, const char * src);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_TYPES_CHAR_ARRAY_H */
