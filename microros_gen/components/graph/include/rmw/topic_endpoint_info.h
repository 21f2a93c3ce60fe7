/* SPDX-License-Identifier: Apache-2.0 */
/* A publisher or subscription of a topic. */
#ifndef MICROROS_RMW_TOPIC_ENDPOINT_INFO_H
#define MICROROS_RMW_TOPIC_ENDPOINT_INFO_H

#include <stdint.h>

#include "rcutils/allocator.h"
#include "rmw/types.h"
#include "rmw/visibility_control.h"
#include "rosidl_runtime_c/type_hash.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_topic_endpoint_info_s {
  const char * node_name;
  const char * node_namespace;
  const char * topic_type; /* as in "std_msgs/msg/Int32" */
  rosidl_type_hash_t topic_type_hash;
  rmw_endpoint_type_t endpoint_type;
  uint8_t endpoint_gid[RMW_GID_STORAGE_SIZE];
  rmw_qos_profile_t qos_profile;
} rmw_topic_endpoint_info_t;

rmw_topic_endpoint_info_t rmw_get_zero_initialized_topic_endpoint_info(void);

/* Frees the strings with the allocator that they are from. */
rmw_ret_t rmw_topic_endpoint_info_fini(
  rmw_topic_endpoint_info_t * topic_endpoint_info, rcutils_allocator_t * allocator);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_TOPIC_ENDPOINT_INFO_H */
