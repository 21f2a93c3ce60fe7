/* SPDX-License-Identifier: Apache-2.0 */
#include "rcutils/types/char_array.h"

#include "microros/rcutils_format.h"
#include "microros/text.h"

#include <string.h>

enum { FIRST_CAPACITY = 32 };

rcutils_char_array_t rcutils_get_zero_initialized_char_array(void)
{
  rcutils_char_array_t array;

  (void)memset(&array, 0, sizeof(array));
  array.owns_buffer = true;
  return array;
}

rcutils_ret_t rcutils_char_array_init(
  rcutils_char_array_t * char_array, size_t buffer_capacity, const rcutils_allocator_t * allocator)
{
  if (char_array == NULL || !rcutils_allocator_is_valid(allocator)) {
    return RCUTILS_RET_ERROR;
  }
  *char_array = rcutils_get_zero_initialized_char_array();
  char_array->allocator = *allocator;
  if (buffer_capacity == 0u) {
    return RCUTILS_RET_OK;
  }
  char_array->buffer = (char *)allocator->allocate(buffer_capacity, allocator->state);
  if (char_array->buffer == NULL) {
    return RCUTILS_RET_BAD_ALLOC;
  }
  char_array->buffer_capacity = buffer_capacity;
  char_array->buffer[0] = '\0';
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_char_array_fini(rcutils_char_array_t * char_array)
{
  if (
    char_array == NULL || (char_array->owns_buffer && !rcutils_allocator_is_valid(&char_array->allocator))) {
    return RCUTILS_RET_ERROR;
  }
  if (char_array->owns_buffer) {
    char_array->allocator.deallocate(char_array->buffer, char_array->allocator.state);
  }
  char_array->buffer = NULL;
  char_array->buffer_length = 0;
  char_array->buffer_capacity = 0;
  return RCUTILS_RET_OK;
}

/* Returns a buffer of the allocator with the text, as far as it fits; NULL without memory. The old one stays then. */
static char * char_array_moved(rcutils_char_array_t * array, size_t new_size)
{
  const rcutils_allocator_t * const allocator = &array->allocator;
  const size_t kept = array->buffer_length < new_size ? array->buffer_length : new_size;
  char * buffer;

  if (array->owns_buffer) {
    return (char *)allocator->reallocate(array->buffer, new_size, allocator->state);
  }
  buffer = (char *)allocator->allocate(new_size, allocator->state);
  if (buffer != NULL && kept != 0u) {
    (void)memcpy(buffer, array->buffer, kept);
  }
  return buffer;
}

rcutils_ret_t rcutils_char_array_resize(rcutils_char_array_t * char_array, size_t new_size)
{
  char * buffer;

  if (char_array == NULL || new_size == 0u || !rcutils_allocator_is_valid(&char_array->allocator)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  if (new_size == char_array->buffer_capacity) {
    return RCUTILS_RET_OK;
  }
  buffer = char_array_moved(char_array, new_size);
  if (buffer == NULL) {
    return RCUTILS_RET_BAD_ALLOC;
  }
  char_array->buffer = buffer;
  char_array->owns_buffer = true;
  char_array->buffer_capacity = new_size;
  if (char_array->buffer_length > new_size) {
    char_array->buffer_length = new_size;
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_char_array_expand_as_needed(rcutils_char_array_t * char_array, size_t new_size)
{
  if (char_array == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  if (new_size == 0u || (char_array->buffer != NULL && new_size <= char_array->buffer_capacity)) {
    return RCUTILS_RET_OK;
  }
  return rcutils_char_array_resize(char_array, new_size);
}

/* Formats into the capacity. Returns false if the text does not fit. */
static bool char_array_print(rcutils_char_array_t * array, const char * format, va_list * args)
{
  microros_format_t out = {array->buffer, 0, 0, false};

  if (array->buffer_capacity == 0u) {
    return false;
  }
  out.size = array->buffer_capacity - 1u;
  microros_format_arguments(&out, format, args);
  out.text[out.used] = '\0';
  array->buffer_length = out.used + 1u;
  return !out.truncated;
}

rcutils_ret_t rcutils_char_array_vsprintf(
  rcutils_char_array_t * char_array, const char * format, va_list args)
{
  rcutils_ret_t ret = RCUTILS_RET_OK;
  bool fits = false;

  if (char_array == NULL || format == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  while (ret == RCUTILS_RET_OK && !fits) {
    va_list copy;

    va_copy(copy, args);
    fits = char_array_print(char_array, format, &copy);
    va_end(copy);
    if (!fits) {
      const size_t capacity = char_array->buffer_capacity;

      ret = rcutils_char_array_resize(char_array, capacity == 0u ? (size_t)FIRST_CAPACITY : 2u * capacity);
    }
  }
  return ret;
}

rcutils_ret_t rcutils_char_array_strncat(rcutils_char_array_t * char_array, const char * src, size_t n)
{
  size_t used;
  size_t added = 0;
  rcutils_ret_t ret;

  if (char_array == NULL || src == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  used = char_array->buffer == NULL ? 0u : microros_text_size(char_array->buffer);
  while (added < n && src[added] != '\0') {
    ++added;
  }
  char_array->buffer_length = used == 0u ? 0u : used + 1u; /* moved with the buffer */
  ret = rcutils_char_array_expand_as_needed(char_array, used + added + 1u);
  if (ret != RCUTILS_RET_OK) {
    return ret;
  }
  (void)memcpy(&char_array->buffer[used], src, added);
  char_array->buffer[used + added] = '\0';
  char_array->buffer_length = used + added + 1u;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_char_array_strcat(rcutils_char_array_t * char_array, const char * src)
{
  return rcutils_char_array_strncat(char_array, src, SIZE_MAX);
}

rcutils_ret_t rcutils_char_array_memcpy(rcutils_char_array_t * char_array, const char * src, size_t n)
{
  rcutils_ret_t ret;

  if (char_array == NULL || src == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  ret = rcutils_char_array_expand_as_needed(char_array, n);
  if (ret != RCUTILS_RET_OK) {
    return ret;
  }
  if (n != 0u) {
    (void)memcpy(char_array->buffer, src, n);
  }
  char_array->buffer_length = n;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_char_array_strcpy(rcutils_char_array_t * char_array, const char * src)
{
  return src == NULL ? RCUTILS_RET_INVALID_ARGUMENT
                     : rcutils_char_array_memcpy(char_array, src, microros_text_size(src) + 1u);
}
