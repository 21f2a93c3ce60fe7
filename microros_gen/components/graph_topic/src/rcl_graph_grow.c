/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_graph.h"
#include "microros/rcl_graph_scan.h"

enum { GROW_STEP = 8 };

bool rcl_graph_grow(void ** array, size_t count, size_t size, const rcutils_allocator_t * allocator)
{
  void * larger;

  if (count % (size_t)GROW_STEP != 0u) {
    return true;
  }
  larger = allocator->reallocate(*array, (count + (size_t)GROW_STEP) * size, allocator->state);
  if (larger != NULL) {
    *array = larger;
  }
  return larger != NULL;
}

void rcl_graph_clear(rcutils_string_array_t * array, const rcutils_allocator_t * allocator)
{
  if (array->data != NULL) {
    (void)rcutils_string_array_fini(array); /* cannot fail: the allocator is valid */
  }
  *array = rcutils_get_zero_initialized_string_array();
  array->allocator = *allocator;
}

bool rcl_graph_add_text(rcutils_string_array_t * array, const char * text, size_t size)
{
  void * data = array->data;

  if (!rcl_graph_grow(&data, array->size, sizeof(char *), &array->allocator)) {
    return false;
  }
  array->data = data;
  array->data[array->size] = rcl_graph_copy(text, size, &array->allocator);
  if (array->data[array->size] == NULL) {
    return false;
  }
  ++array->size;
  return true;
}
