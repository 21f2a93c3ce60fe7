/* SPDX-License-Identifier: Apache-2.0 */
/* The expansion of names whose contents are known when they are passed. Internal. */
#ifndef MICROROS_RCL_NAMES_EXPAND_H
#define MICROROS_RCL_NAMES_EXPAND_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes of a fully qualified name, of a node's and of a namespace, with the NUL (RMW_TOPIC_MAX_NAME_LENGTH and its like). */
enum { RCL_NAMES_FULL_SIZE = 248, RCL_NAMES_NODE_SIZE = 256, RCL_NAMES_NAMESPACE_SIZE = 246 };

/* Returns the value of the substitution whose name is `key`, of `size` bytes; NULL: there is none. */
typedef const char * (*rcl_names_lookup_t)(const void * values, const char * key, size_t size);

typedef struct rcl_names_scope_t {
  const char * node;
  const char * namespace_;   /* "/" or "/a/b" */
  rcl_names_lookup_t lookup; /* what is neither {node} nor {ns} nor {namespace}; may be NULL */
  const void * values;
} rcl_names_scope_t;

/*
 * Writes the fully qualified name of a topic that rcl_validate_topic_name accepts, at most `size` bytes with the NUL, and
 * returns how many bytes it has without; 0: a substitution is not known. The result is no name yet when values make it
 * none: rcl_names_check_full says so.
 */
size_t rcl_names_expand(const char * topic, const rcl_names_scope_t * scope, char * full, size_t size);

/* Returns what is wrong with a fully qualified name of `size` bytes, as a static text; NULL: nothing. */
const char * rcl_names_check_full(const char * full, size_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NAMES_EXPAND_H */
