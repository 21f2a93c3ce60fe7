/* SPDX-License-Identifier: Apache-2.0 */
#include "rosidl_runtime_c/primitives_sequence_functions.h"

#include "microros/message_pools.h"

#include <stdint.h>
#include <string.h>

static void * sequence_allocate(const microros_pool_t * pool, size_t size, size_t element_size)
{
  size_t room = size > SIZE_MAX / element_size ? SIZE_MAX : size * element_size;

  return microros_memory_take(pool, &room);
}

/*
 * Returns memory for `size` elements: `data`, or a larger block that replaces it and loses its contents;
 * NULL, with nothing changed, on failure. */
static void * sequence_grow(const microros_pool_t * pool, void * data, size_t size, size_t element_size)
{
  void * larger;

  if (microros_memory_room(pool, data) / element_size >= size) {
    return data;
  }
  larger = sequence_allocate(pool, size, element_size);
  if (larger != NULL) {
    microros_memory_give_back(pool, data);
  }
  return larger;
}

/* One group of functions per type, since C has no generics. Elements are compared as numbers. */
#define PRIMITIVE_SEQUENCE_FUNCTIONS(NAME, SEQUENCE, TYPE) \
  bool rosidl_runtime_c__##NAME##__Sequence__init( \
    rosidl_runtime_c__##SEQUENCE##__Sequence * sequence, size_t size) \
  { \
    TYPE * data = NULL; \
    if (sequence == NULL) { \
      return false; \
    } \
    if (size != 0u) { \
      data = sequence_allocate(MICROROS_POOL_##SEQUENCE, size, sizeof(TYPE)); \
      if (data == NULL) { \
        return false; \
      } \
    } \
    sequence->data = data; \
    sequence->size = size; \
    sequence->capacity = size; \
    return true; \
  } \
  void rosidl_runtime_c__##NAME##__Sequence__fini(rosidl_runtime_c__##SEQUENCE##__Sequence * sequence) \
  { \
    if (sequence == NULL) { \
      return; \
    } \
    microros_memory_give_back(MICROROS_POOL_##SEQUENCE, sequence->data); \
    sequence->data = NULL; \
    sequence->size = 0; \
    sequence->capacity = 0; \
  } \
  bool rosidl_runtime_c__##NAME##__Sequence__are_equal( \
    const rosidl_runtime_c__##SEQUENCE##__Sequence * lhs, \
    const rosidl_runtime_c__##SEQUENCE##__Sequence * rhs) \
  { \
    if (lhs == NULL || rhs == NULL || lhs->size != rhs->size) { \
      return false; \
    } \
    for (size_t i = 0; i < lhs->size; ++i) { \
      if (lhs->data[i] != rhs->data[i]) { \
        return false; \
      } \
    } \
    return true; \
  } \
  bool rosidl_runtime_c__##NAME##__Sequence__copy( \
    const rosidl_runtime_c__##SEQUENCE##__Sequence * input, \
    rosidl_runtime_c__##SEQUENCE##__Sequence * output) \
  { \
    if (input == NULL || output == NULL) { \
      return false; \
    } \
    if (output->capacity < input->size) { \
      TYPE * data = sequence_grow(MICROROS_POOL_##SEQUENCE, output->data, input->size, sizeof(TYPE)); \
      if (data == NULL) { \
        return false; \
      } \
      output->data = data; \
      output->capacity = input->size; \
    } \
    if (input->size != 0u) { \
      (void)memcpy(output->data, input->data, input->size * sizeof(TYPE)); \
    } \
    output->size = input->size; \
    return true; \
  }

PRIMITIVE_SEQUENCE_FUNCTIONS(float, float, float)
PRIMITIVE_SEQUENCE_FUNCTIONS(double, double, double)
PRIMITIVE_SEQUENCE_FUNCTIONS(long_double, long_double, long double)
PRIMITIVE_SEQUENCE_FUNCTIONS(char, char, signed char)
PRIMITIVE_SEQUENCE_FUNCTIONS(wchar, wchar, uint16_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(boolean, boolean, bool)
PRIMITIVE_SEQUENCE_FUNCTIONS(octet, octet, uint8_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(uint8, uint8, uint8_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(int8, int8, int8_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(uint16, uint16, uint16_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(int16, int16, int16_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(uint32, uint32, uint32_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(int32, int32, int32_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(uint64, uint64, uint64_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(int64, int64, int64_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(bool, boolean, bool)
PRIMITIVE_SEQUENCE_FUNCTIONS(byte, octet, uint8_t)
PRIMITIVE_SEQUENCE_FUNCTIONS(float32, float, float)
PRIMITIVE_SEQUENCE_FUNCTIONS(float64, double, double)
