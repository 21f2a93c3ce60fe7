/* SPDX-License-Identifier: Apache-2.0 */
/* Fully qualified names. They are strings of the allocator that the caller gives; nothing else here takes memory. */
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
 * Gives what a topic or service is called in a node: `data` is /ns/data, `~/data` /ns/node/data; {node}, {ns} and
 * {namespace} are replaced, and what `substitutions` has beside them, by values that are taken as they are. The result
 * belongs to the caller, who gives it back to `allocator`. It need not be a name: rcl_node_resolve_name looks at that too.
 * RCL_RET_INVALID_ARGUMENT, RCL_RET_TOPIC_NAME_INVALID, RCL_RET_NODE_INVALID_NAME, RCL_RET_NODE_INVALID_NAMESPACE,
 * RCL_RET_UNKNOWN_SUBSTITUTION, RCL_RET_BAD_ALLOC; *output_topic_name is set on success alone.
 */
rcl_ret_t rcl_expand_topic_name(
  const char * input_topic_name, const char * node_name, const char * node_namespace,
  const rcutils_string_map_t * substitutions, rcl_allocator_t allocator, char ** output_topic_name);

/* Adds nothing: ROS 2 has no substitutions but those above. RCL_RET_INVALID_ARGUMENT. */
rcl_ret_t rcl_get_default_topic_name_substitutions(rcutils_string_map_t * string_map);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_EXPAND_TOPIC_NAME_H */
