/* SPDX-License-Identifier: Apache-2.0 */
/* Names in parts: an expanded name is compared and copied without a separate buffer. */
#ifndef MICROROS_RMW_NAMES_H
#define MICROROS_RMW_NAMES_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_name_t {
  const char * part[4]; /* concatenated; "" if unused */
} rmw_name_t;

/* Returns a namespace with a leading slash, which the caller may have omitted. */
rmw_name_t rmw_name_of_namespace(const char * namespace_);

/* Resolves a valid topic name in a node: "chatter" is /ns/chatter, "~/x" is /ns/node/x, "/x" stays. */
rmw_name_t rmw_name_of_topic(const char * topic, const char * node, const char * namespace_);

bool rmw_name_equals(const rmw_name_t * name, const char * text);

/* Returns the number of bytes without the NUL. */
size_t rmw_name_size(const rmw_name_t * name);

/* Writes the name and a NUL: rmw_name_size + 1 bytes. */
void rmw_name_copy(const rmw_name_t * name, char * buffer);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_NAMES_H */
