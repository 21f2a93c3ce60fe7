/* SPDX-License-Identifier: Apache-2.0 */
/* A buffer of bytes with its allocator. */
#ifndef MICROROS_RCUTILS_TYPES_UINT8_ARRAY_H
#define MICROROS_RCUTILS_TYPES_UINT8_ARRAY_H

#include <stddef.h>
#include <stdint.h>

#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcutils_uint8_array_s {
  uint8_t * buffer;
  size_t buffer_length;
  size_t buffer_capacity;
  rcutils_allocator_t allocator;
} rcutils_uint8_array_t;

rcutils_uint8_array_t rcutils_get_zero_initialized_uint8_array(void);

rcutils_ret_t rcutils_uint8_array_init(
  rcutils_uint8_array_t * uint8_array, size_t buffer_capacity, const rcutils_allocator_t * allocator);

rcutils_ret_t rcutils_uint8_array_fini(rcutils_uint8_array_t * uint8_array);

/* Changes the capacity to `new_size`, not 0; a smaller one truncates the contents. */
rcutils_ret_t rcutils_uint8_array_resize(rcutils_uint8_array_t * uint8_array, size_t new_size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_TYPES_UINT8_ARRAY_H */
