/* SPDX-License-Identifier: Apache-2.0 */
/* Fully qualified names: strings of the caller's allocator; nothing else here allocates. */
#ifndef MICROROS_RCL_EXPAND_TOPIC_NAME_H
#define MICROROS_RCL_EXPAND_TOPIC_NAME_H

#include "rcl/allocator.h"
#include "rcl/macros.h"
#include "rcl/types.h"
#include "rcl/visibility_control.h"
#include "rcutils/types/string_map.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Expands a topic or service name in a node: `data` becomes /ns/data, `~/data` /ns/node/data; {node},
 * {ns}, {namespace} and further keys in `substitutions` are replaced by their values verbatim. The result
 * belongs to the caller, who frees it with `allocator`. It may be an invalid name, which
 * rcl_node_resolve_name checks, too. RCL_RET_INVALID_ARGUMENT, RCL_RET_TOPIC_NAME_INVALID,
 * RCL_RET_NODE_INVALID_NAME, RCL_RET_NODE_INVALID_NAMESPACE, RCL_RET_UNKNOWN_SUBSTITUTION,
 * RCL_RET_BAD_ALLOC; *output_topic_name is only set on success.
 */
rcl_ret_t rcl_expand_topic_name(
  const char * input_topic_name, const char * node_name, const char * node_namespace,
  const rcutils_string_map_t * substitutions, rcl_allocator_t allocator, char ** output_topic_name);

/* Adds nothing: ROS 2 has no substitutions beyond those above. RCL_RET_INVALID_ARGUMENT. */
rcl_ret_t rcl_get_default_topic_name_substitutions(rcutils_string_map_t * string_map);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_EXPAND_TOPIC_NAME_H */
