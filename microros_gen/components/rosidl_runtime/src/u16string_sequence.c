/* SPDX-License-Identifier: Apache-2.0 */
#include "rosidl_runtime_c/u16string_functions.h"

#include "microros/message_pools.h"
#include "rcutils/allocator.h"

#include <stdint.h>

/* Makes the strings from `first` up to `last` empty, which cannot fail. */
static void u16strings_begin(rosidl_runtime_c__U16String * data, size_t first, size_t last)
{
  for (size_t i = first; i < last; ++i) {
    (void)rosidl_runtime_c__U16String__init(&data[i]);
  }
}

bool rosidl_runtime_c__U16String__Sequence__init(
  rosidl_runtime_c__U16String__Sequence * sequence, size_t size)
{
  rosidl_runtime_c__U16String * data = NULL;

  if (sequence == NULL || size > SIZE_MAX / sizeof(*data)) {
    return false;
  }
  if (size != 0u) {
    size_t room = size * sizeof(*data);

    data = microros_memory_take(MICROROS_POOL_u16string, &room);
    if (data == NULL) {
      return false;
    }
  }
  u16strings_begin(data, 0, size);
  sequence->data = data;
  sequence->size = size;
  sequence->capacity = size;
  return true;
}

void rosidl_runtime_c__U16String__Sequence__fini(rosidl_runtime_c__U16String__Sequence * sequence)
{
  if (sequence == NULL) {
    return;
  }
  if (sequence->data != NULL) {
    for (size_t i = 0; i < sequence->capacity; ++i) {
      rosidl_runtime_c__U16String__fini(&sequence->data[i]);
    }
    microros_memory_give_back(MICROROS_POOL_u16string, sequence->data);
  }
  sequence->data = NULL;
  sequence->size = 0;
  sequence->capacity = 0;
}

bool rosidl_runtime_c__U16String__Sequence__are_equal(
  const rosidl_runtime_c__U16String__Sequence * lhs, const rosidl_runtime_c__U16String__Sequence * rhs)
{
  if (lhs == NULL || rhs == NULL || lhs->size != rhs->size) {
    return false;
  }
  for (size_t i = 0; i < lhs->size; ++i) {
    if (!rosidl_runtime_c__U16String__are_equal(&lhs->data[i], &rhs->data[i])) {
      return false;
    }
  }
  return true;
}

/* Ensures room for `size` strings: in the existing block if possible, otherwise in a larger one. */
static bool u16strings_grow(rosidl_runtime_c__U16String__Sequence * sequence, size_t size)
{
  rosidl_runtime_c__U16String__Sequence larger;

  if (microros_memory_room(MICROROS_POOL_u16string, sequence->data) / sizeof(*sequence->data) >= size) {
    u16strings_begin(sequence->data, sequence->capacity, size);
    sequence->capacity = size;
    return true;
  }
  if (!rosidl_runtime_c__U16String__Sequence__init(&larger, size)) {
    return false;
  }
  rosidl_runtime_c__U16String__Sequence__fini(sequence);
  *sequence = larger;
  return true;
}

bool rosidl_runtime_c__U16String__Sequence__copy(
  const rosidl_runtime_c__U16String__Sequence * input, rosidl_runtime_c__U16String__Sequence * output)
{
  if (input == NULL || output == NULL) {
    return false;
  }
  if (output->capacity < input->size && !u16strings_grow(output, input->size)) {
    return false;
  }
  output->size = input->size;
  for (size_t i = 0; i < input->size; ++i) {
    if (!rosidl_runtime_c__U16String__copy(&input->data[i], &output->data[i])) {
      return false;
    }
  }
  return true;
}

rosidl_runtime_c__U16String__Sequence * rosidl_runtime_c__U16String__Sequence__create(size_t size)
{
  rcutils_allocator_t allocator = rcutils_get_default_allocator();
  rosidl_runtime_c__U16String__Sequence * sequence = allocator.allocate(sizeof(*sequence), allocator.state);

  if (sequence != NULL && !rosidl_runtime_c__U16String__Sequence__init(sequence, size)) {
    allocator.deallocate(sequence, allocator.state);
    sequence = NULL;
  }
  return sequence;
}

void rosidl_runtime_c__U16String__Sequence__destroy(rosidl_runtime_c__U16String__Sequence * sequence)
{
  if (sequence != NULL) {
    rcutils_allocator_t allocator = rcutils_get_default_allocator();

    rosidl_runtime_c__U16String__Sequence__fini(sequence);
    allocator.deallocate(sequence, allocator.state);
  }
}
