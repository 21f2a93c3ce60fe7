/* SPDX-License-Identifier: Apache-2.0 */
#include "rosidl_runtime_c/string_functions.h"

#include "rcutils/allocator.h"

#include <stdint.h>

bool rosidl_runtime_c__String__Sequence__init(rosidl_runtime_c__String__Sequence * sequence, size_t size)
{
  rosidl_runtime_c__String * data = NULL;

  if (sequence == NULL || size > SIZE_MAX / sizeof(*data)) {
    return false;
  }
  if (size != 0u) {
    const rcutils_allocator_t allocator = rcutils_get_default_allocator();

    data = allocator.allocate(size * sizeof(*data), allocator.state);
    if (data == NULL) {
      return false;
    }
  }
  for (size_t i = 0; i < size; ++i) {
    (void)rosidl_runtime_c__String__init(&data[i]); /* an empty string needs nothing that could fail */
  }
  sequence->data = data;
  sequence->size = size;
  sequence->capacity = size;
  return true;
}

void rosidl_runtime_c__String__Sequence__fini(rosidl_runtime_c__String__Sequence * sequence)
{
  if (sequence == NULL) {
    return;
  }
  if (sequence->data != NULL) {
    const rcutils_allocator_t allocator = rcutils_get_default_allocator();

    for (size_t i = 0; i < sequence->capacity; ++i) {
      rosidl_runtime_c__String__fini(&sequence->data[i]);
    }
    allocator.deallocate(sequence->data, allocator.state);
  }
  sequence->data = NULL;
  sequence->size = 0;
  sequence->capacity = 0;
}

bool rosidl_runtime_c__String__Sequence__are_equal(
  const rosidl_runtime_c__String__Sequence * lhs, const rosidl_runtime_c__String__Sequence * rhs)
{
  if (lhs == NULL || rhs == NULL || lhs->size != rhs->size) {
    return false;
  }
  for (size_t i = 0; i < lhs->size; ++i) {
    if (!rosidl_runtime_c__String__are_equal(&lhs->data[i], &rhs->data[i])) {
      return false;
    }
  }
  return true;
}

bool rosidl_runtime_c__String__Sequence__copy(
  const rosidl_runtime_c__String__Sequence * input, rosidl_runtime_c__String__Sequence * output)
{
  if (input == NULL || output == NULL) {
    return false;
  }
  if (output->capacity < input->size) {
    rosidl_runtime_c__String__Sequence larger;

    if (!rosidl_runtime_c__String__Sequence__init(&larger, input->size)) {
      return false;
    }
    rosidl_runtime_c__String__Sequence__fini(output);
    *output = larger;
  }
  output->size = input->size;
  for (size_t i = 0; i < input->size; ++i) {
    if (!rosidl_runtime_c__String__copy(&input->data[i], &output->data[i])) {
      return false;
    }
  }
  return true;
}

rosidl_runtime_c__String__Sequence * rosidl_runtime_c__String__Sequence__create(size_t size)
{
  rcutils_allocator_t allocator = rcutils_get_default_allocator();
  rosidl_runtime_c__String__Sequence * sequence = allocator.allocate(sizeof(*sequence), allocator.state);

  if (sequence != NULL && !rosidl_runtime_c__String__Sequence__init(sequence, size)) {
    allocator.deallocate(sequence, allocator.state);
    sequence = NULL;
  }
  return sequence;
}

void rosidl_runtime_c__String__Sequence__destroy(rosidl_runtime_c__String__Sequence * sequence)
{
  if (sequence != NULL) {
    rcutils_allocator_t allocator = rcutils_get_default_allocator();

    rosidl_runtime_c__String__Sequence__fini(sequence);
    allocator.deallocate(sequence, allocator.state);
  }
}
