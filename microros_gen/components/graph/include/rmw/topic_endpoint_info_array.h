/* SPDX-License-Identifier: Apache-2.0 */
/* Publishers or subscriptions of a topic. */
#ifndef MICROROS_RMW_TOPIC_ENDPOINT_INFO_ARRAY_H
#define MICROROS_RMW_TOPIC_ENDPOINT_INFO_ARRAY_H

#include <stddef.h>

#include "rcutils/allocator.h"
#include "rmw/topic_endpoint_info.h"
#include "rmw/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_topic_endpoint_info_array_s {
  size_t size;
  rmw_topic_endpoint_info_t * info_array;
} rmw_topic_endpoint_info_array_t;

rmw_topic_endpoint_info_array_t rmw_get_zero_initialized_topic_endpoint_info_array(void);

/* Returns RMW_RET_OK if nothing is allocated, RMW_RET_ERROR otherwise. */
rmw_ret_t rmw_topic_endpoint_info_array_check_zero(
  rmw_topic_endpoint_info_array_t * topic_endpoint_info_array);

/* Makes room for `size` endpoints, all zero. RMW_RET_BAD_ALLOC as for rmw_names_and_types_init. */
rmw_ret_t rmw_topic_endpoint_info_array_init_with_size(
  rmw_topic_endpoint_info_array_t * topic_endpoint_info_array, size_t size, rcutils_allocator_t * allocator);

/* Frees the array and its strings with the allocator that they are from. */
rmw_ret_t rmw_topic_endpoint_info_array_fini(
  rmw_topic_endpoint_info_array_t * topic_endpoint_info_array, rcutils_allocator_t * allocator);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_TOPIC_ENDPOINT_INFO_ARRAY_H */
