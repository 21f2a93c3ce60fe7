/* SPDX-License-Identifier: Apache-2.0 */
/* Copies of texts. */
#include "microros/rmw_local_copy.h"

#include <stddef.h>
#include <string.h>

bool rmw_local_copy_text(const rosidl_runtime_c__String * from, rosidl_runtime_c__String * to)
{
  const size_t capacity = to->data == NULL ? 0u : to->capacity;

  if (from->size != 0u) {
    if (from->size >= capacity) {
      return false;
    }
    (void)memcpy(to->data, from->data, from->size); /* at most MICROROS_LOCAL_TEXT bytes */
  }
  if (capacity > 1u || (capacity == 1u && to->data[0] != '\0')) {
    to->data[from->size] = '\0'; /* but not over the terminator that all initialized strings share */
  }
  to->size = from->size;
  return true;
}

bool rmw_local_copy_wide(const rosidl_runtime_c__U16String * from, rosidl_runtime_c__U16String * to)
{
  const size_t capacity = to->data == NULL ? 0u : to->capacity;

  if (from->size != 0u) {
    if (from->size >= capacity) {
      return false;
    }
    /* at most 2 * MICROROS_LOCAL_TEXT bytes */
    (void)memcpy(to->data, from->data, from->size * sizeof(*to->data));
  }
  if (capacity > 1u || (capacity == 1u && to->data[0] != 0u)) {
    to->data[from->size] = 0u; /* but not over the terminator that all initialized strings share */
  }
  to->size = from->size;
  return true;
}
