/* SPDX-License-Identifier: Apache-2.0 */
#include "rcutils/allocator.h"

#include "microros/arena.h"
#include "rcutils/types/string_array.h"
#include "rcutils/types/uint8_array.h"

#include <string.h>

/* Returns the allocator set by rcutils_set_default_allocator: one for all, since the getter takes no
 * handle. Not linked if no one sets it. */
static const rcutils_allocator_t ** allocator_chosen(void)
{
  static const rcutils_allocator_t * chosen;

  return &chosen;
}

rcutils_allocator_t rcutils_get_zero_initialized_allocator(void)
{
  rcutils_allocator_t allocator;

  (void)memset(&allocator, 0, sizeof(allocator));
  return allocator;
}

rcutils_allocator_t rcutils_get_default_allocator(void)
{
  const rcutils_allocator_t arena = {
    microros_arena_allocate, microros_arena_deallocate, microros_arena_reallocate,
    microros_arena_zero_allocate, NULL};

  const rcutils_allocator_t * chosen = *allocator_chosen();

  return chosen != NULL ? *chosen : arena;
}

bool rcutils_set_default_allocator(rcutils_allocator_t * allocator)
{
  static rcutils_allocator_t kept;

  if (!rcutils_allocator_is_valid(allocator)) {
    return false;
  }
  kept = *allocator;
  *allocator_chosen() = &kept;
  return true;
}

bool rcutils_allocator_is_valid(const rcutils_allocator_t * allocator)
{
  return allocator != NULL && allocator->allocate != NULL && allocator->deallocate != NULL &&
         allocator->reallocate != NULL && allocator->zero_allocate != NULL;
}

void * rcutils_reallocf(void * pointer, size_t size, rcutils_allocator_t * allocator)
{
  void * memory;

  if (!rcutils_allocator_is_valid(allocator)) {
    return NULL;
  }
  memory = allocator->reallocate(pointer, size, allocator->state);
  if (memory == NULL) {
    allocator->deallocate(pointer, allocator->state);
  }
  return memory;
}

rcutils_string_array_t rcutils_get_zero_initialized_string_array(void)
{
  rcutils_string_array_t array;

  (void)memset(&array, 0, sizeof(array));
  return array;
}

rcutils_ret_t rcutils_string_array_init(
  rcutils_string_array_t * string_array, size_t size, const rcutils_allocator_t * allocator)
{
  if (string_array == NULL || !rcutils_allocator_is_valid(allocator)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  string_array->data = allocator->zero_allocate(size, sizeof(char *), allocator->state);
  if (string_array->data == NULL && size != 0u) {
    return RCUTILS_RET_BAD_ALLOC;
  }
  string_array->size = size;
  string_array->allocator = *allocator;
  return RCUTILS_RET_OK;
}

/* Frees the strings from `first` on. */
static void strings_release(rcutils_string_array_t * string_array, size_t first)
{
  const rcutils_allocator_t * allocator = &string_array->allocator;

  for (size_t i = first; i < string_array->size; ++i) {
    allocator->deallocate(string_array->data[i], allocator->state);
    string_array->data[i] = NULL;
  }
}

rcutils_ret_t rcutils_string_array_fini(rcutils_string_array_t * string_array)
{
  if (string_array == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  if (string_array->data == NULL) {
    return RCUTILS_RET_OK;
  }
  if (!rcutils_allocator_is_valid(&string_array->allocator)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  strings_release(string_array, 0);
  string_array->allocator.deallocate(string_array->data, string_array->allocator.state);
  string_array->data = NULL;
  string_array->size = 0;
  return RCUTILS_RET_OK;
}

static int strings_order(size_t left, size_t right)
{
  if (left == right) {
    return 0;
  }
  return left < right ? -1 : 1;
}

/* strcmp: the library uses no functions of the C library except those that copy and fill. */
static int strings_compare(const char * left, const char * right)
{
  while (*left != '\0' && *left == *right) {
    ++left;
    ++right;
  }
  return strings_order((size_t)(unsigned char)*left, (size_t)(unsigned char)*right);
}

rcutils_ret_t rcutils_string_array_cmp(
  const rcutils_string_array_t * lhs, const rcutils_string_array_t * rhs, int * res)
{
  size_t common;

  if (lhs == NULL || rhs == NULL || res == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  common = lhs->size < rhs->size ? lhs->size : rhs->size;
  if (common != 0u && (lhs->data == NULL || rhs->data == NULL)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  for (size_t i = 0; i < common; ++i) {
    if (lhs->data[i] == NULL || rhs->data[i] == NULL) {
      return RCUTILS_RET_ERROR;
    }
    *res = strings_compare(lhs->data[i], rhs->data[i]);
    if (*res != 0) {
      return RCUTILS_RET_OK;
    }
  }
  *res = strings_order(lhs->size, rhs->size);
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_array_resize(rcutils_string_array_t * string_array, size_t new_size)
{
  const rcutils_allocator_t * allocator;
  char ** data;

  if (string_array == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  if (string_array->size == new_size) {
    return RCUTILS_RET_OK;
  }
  allocator = &string_array->allocator;
  if (!rcutils_allocator_is_valid(allocator)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  if (new_size == 0u) {
    return rcutils_string_array_fini(string_array);
  }
  strings_release(string_array, new_size);
  data = allocator->reallocate(string_array->data, new_size * sizeof(char *), allocator->state);
  if (data == NULL && new_size > string_array->size) {
    return RCUTILS_RET_BAD_ALLOC;
  }
  string_array->data = data != NULL ? data : string_array->data;
  for (size_t i = string_array->size; i < new_size; ++i) {
    string_array->data[i] = NULL;
  }
  string_array->size = new_size;
  return RCUTILS_RET_OK;
}

int rcutils_string_array_sort_compare(const void * lhs, const void * rhs)
{
  const char * const * left = lhs;
  const char * const * right = rhs;

  if (*left != NULL && *right != NULL) {
    return strings_compare(*left, *right);
  }
  if (*left == *right) {
    return 0;
  }
  return *left == NULL ? 1 : -1;
}

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
