/* SPDX-License-Identifier: Apache-2.0 */
/* Expansion of names that are only known at run time. Internal. */
#ifndef MICROROS_RCL_NAMES_EXPAND_H
#define MICROROS_RCL_NAMES_EXPAND_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Sizes of a fully qualified name, of a node name and of a namespace, including the NUL
 * (RMW_TOPIC_MAX_NAME_LENGTH and similar). */
enum { RCL_NAMES_FULL_SIZE = 248, RCL_NAMES_NODE_SIZE = 256, RCL_NAMES_NAMESPACE_SIZE = 246 };

/* Returns the value of the substitution `key`, of `size` bytes; NULL if it is unknown. */
typedef const char * (*rcl_names_lookup_t)(const void * values, const char * key, size_t size);

typedef struct rcl_names_scope_t {
  const char * node;
  const char * namespace_;   /* "/" or "/a/b" */
  rcl_names_lookup_t lookup; /* for keys other than {node}, {ns} and {namespace}; may be NULL */
  const void * values;
} rcl_names_scope_t;

/*
 * Writes the fully qualified name of a topic that rcl_validate_topic_name accepts, at most `size` bytes
 * including the NUL. Returns its length without the NUL; 0 for an unknown substitution. Values may make
 * the result invalid: check it with rcl_names_check_full.
 */
size_t rcl_names_expand(const char * topic, const rcl_names_scope_t * scope, char * full, size_t size);

/* Returns the fault of a fully qualified name of `size` bytes, as a static text; NULL if it is valid. */
const char * rcl_names_check_full(const char * full, size_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NAMES_EXPAND_H */
