/* SPDX-License-Identifier: Apache-2.0 */
/* What queries of the graph return: names with their types, and endpoints. */
#include "rmw/names_and_types.h"

#include "microros/error.h"
#include "rmw/topic_endpoint_info_array.h"

#include <string.h>

rmw_names_and_types_t rmw_get_zero_initialized_names_and_types(void)
{
  rmw_names_and_types_t names_and_types;

  (void)memset(&names_and_types, 0, sizeof(names_and_types));
  return names_and_types;
}

/* cppcheck-suppress constParameterPointer ; the signature is that of ROS 2 */
rmw_ret_t rmw_names_and_types_check_zero(rmw_names_and_types_t * names_and_types)
{
  if (
    names_and_types == NULL || names_and_types->names.size != 0u || names_and_types->names.data != NULL ||
    names_and_types->types != NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "names_and_types");
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_names_and_types_init(
  rmw_names_and_types_t * names_and_types, size_t size, rcutils_allocator_t * allocator)
{
  if (names_and_types == NULL || !rcutils_allocator_is_valid(allocator)) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "names_and_types or allocator");
  }
  *names_and_types = rmw_get_zero_initialized_names_and_types();
  if (rcutils_string_array_init(&names_and_types->names, size, allocator) != RCUTILS_RET_OK) {
    return RMW_RET_BAD_ALLOC;
  }
  if (size != 0u) {
    names_and_types->types = allocator->zero_allocate(size, sizeof(rcutils_string_array_t), allocator->state);
    if (names_and_types->types == NULL) {
      (void)rcutils_string_array_fini(&names_and_types->names); /* cannot fail: the allocator is valid */
      return RMW_RET_BAD_ALLOC;
    }
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_names_and_types_fini(rmw_names_and_types_t * names_and_types)
{
  rcutils_allocator_t allocator;
  rcutils_ret_t result = RCUTILS_RET_OK;

  if (names_and_types == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "names_and_types");
  }
  allocator = names_and_types->names.allocator;
  if (names_and_types->types != NULL) {
    for (size_t i = 0; i < names_and_types->names.size && result == RCUTILS_RET_OK; ++i) {
      result = rcutils_string_array_fini(&names_and_types->types[i]);
    }
    if (result != RCUTILS_RET_OK || !rcutils_allocator_is_valid(&allocator)) {
      return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "names_and_types");
    }
    allocator.deallocate(names_and_types->types, allocator.state);
    names_and_types->types = NULL;
  }
  result = rcutils_string_array_fini(&names_and_types->names);
  return result == RCUTILS_RET_OK ? RMW_RET_OK
                                  : microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "names_and_types");
}

rmw_topic_endpoint_info_t rmw_get_zero_initialized_topic_endpoint_info(void)
{
  rmw_topic_endpoint_info_t info;

  (void)memset(&info, 0, sizeof(info));
  return info;
}

/* The strings are const for readers alone: they are memory of the allocator. */
static void info_free(const char * text, const rcutils_allocator_t * allocator)
{
  void * memory;

  (void)memcpy(&memory, &text, sizeof(memory));
  allocator->deallocate(memory, allocator->state);
}

rmw_ret_t rmw_topic_endpoint_info_fini(
  rmw_topic_endpoint_info_t * topic_endpoint_info, rcutils_allocator_t * allocator)
{
  if (topic_endpoint_info == NULL || !rcutils_allocator_is_valid(allocator)) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "topic_endpoint_info or allocator");
  }
  info_free(topic_endpoint_info->node_name, allocator);
  info_free(topic_endpoint_info->node_namespace, allocator);
  info_free(topic_endpoint_info->topic_type, allocator);
  *topic_endpoint_info = rmw_get_zero_initialized_topic_endpoint_info();
  return RMW_RET_OK;
}

rmw_topic_endpoint_info_array_t rmw_get_zero_initialized_topic_endpoint_info_array(void)
{
  const rmw_topic_endpoint_info_array_t array = {0, NULL};

  return array;
}

/* cppcheck-suppress constParameterPointer ; the signature is that of ROS 2 */
rmw_ret_t rmw_topic_endpoint_info_array_check_zero(
  rmw_topic_endpoint_info_array_t * topic_endpoint_info_array)
{
  if (topic_endpoint_info_array == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "topic_endpoint_info_array");
  }
  if (topic_endpoint_info_array->size != 0u || topic_endpoint_info_array->info_array != NULL) {
    return microros_error_refuse(RMW_RET_ERROR, "topic_endpoint_info_array");
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_topic_endpoint_info_array_init_with_size(
  rmw_topic_endpoint_info_array_t * topic_endpoint_info_array, size_t size, rcutils_allocator_t * allocator)
{
  if (topic_endpoint_info_array == NULL || !rcutils_allocator_is_valid(allocator)) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "topic_endpoint_info_array or allocator");
  }
  *topic_endpoint_info_array = rmw_get_zero_initialized_topic_endpoint_info_array();
  if (size != 0u) {
    topic_endpoint_info_array->info_array =
      allocator->zero_allocate(size, sizeof(rmw_topic_endpoint_info_t), allocator->state);
    if (topic_endpoint_info_array->info_array == NULL) {
      return RMW_RET_BAD_ALLOC;
    }
    topic_endpoint_info_array->size = size;
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_topic_endpoint_info_array_fini(
  rmw_topic_endpoint_info_array_t * topic_endpoint_info_array, rcutils_allocator_t * allocator)
{
  if (topic_endpoint_info_array == NULL || !rcutils_allocator_is_valid(allocator)) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "topic_endpoint_info_array or allocator");
  }
  for (size_t i = 0; i < topic_endpoint_info_array->size; ++i) {
    (void)rmw_topic_endpoint_info_fini(
      &topic_endpoint_info_array->info_array[i], allocator); /* both are valid */
  }
  allocator->deallocate(topic_endpoint_info_array->info_array, allocator->state);
  *topic_endpoint_info_array = rmw_get_zero_initialized_topic_endpoint_info_array();
  return RMW_RET_OK;
}
