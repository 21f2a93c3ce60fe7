/* SPDX-License-Identifier: Apache-2.0 */
#include "rcutils/types/uint8_array.h"

#include <string.h>

rcutils_uint8_array_t rcutils_get_zero_initialized_uint8_array(void)
{
  rcutils_uint8_array_t array;

  (void)memset(&array, 0, sizeof(array));
  return array;
}

rcutils_ret_t rcutils_uint8_array_init(
  rcutils_uint8_array_t * uint8_array, size_t buffer_capacity, const rcutils_allocator_t * allocator)
{
  if (uint8_array == NULL || !rcutils_allocator_is_valid(allocator)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  uint8_array->allocator = *allocator;
  uint8_array->buffer_length = 0;
  uint8_array->buffer_capacity = 0;
  uint8_array->buffer = NULL;
  if (buffer_capacity == 0u) {
    return RCUTILS_RET_OK;
  }
  uint8_array->buffer = allocator->allocate(buffer_capacity, allocator->state);
  if (uint8_array->buffer == NULL) {
    return RCUTILS_RET_BAD_ALLOC;
  }
  uint8_array->buffer_capacity = buffer_capacity;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_uint8_array_fini(rcutils_uint8_array_t * uint8_array)
{
  if (uint8_array == NULL || !rcutils_allocator_is_valid(&uint8_array->allocator)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  uint8_array->allocator.deallocate(uint8_array->buffer, uint8_array->allocator.state);
  uint8_array->buffer = NULL;
  uint8_array->buffer_length = 0;
  uint8_array->buffer_capacity = 0;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_uint8_array_resize(rcutils_uint8_array_t * uint8_array, size_t new_size)
{
  uint8_t * buffer;

  if (uint8_array == NULL || new_size == 0u || !rcutils_allocator_is_valid(&uint8_array->allocator)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  buffer = uint8_array->allocator.reallocate(uint8_array->buffer, new_size, uint8_array->allocator.state);
  if (buffer == NULL) {
    return RCUTILS_RET_BAD_ALLOC;
  }
  uint8_array->buffer = buffer;
  uint8_array->buffer_capacity = new_size;
  if (uint8_array->buffer_length > new_size) {
    uint8_array->buffer_length = new_size;
  }
  return RCUTILS_RET_OK;
}
