/* SPDX-License-Identifier: Apache-2.0 */
/* The name of a topic or service on its way down. A component that substitutes brings another file of this name. */
#ifndef MICROROS_RCL_NAMES_TAKE_H
#define MICROROS_RCL_NAMES_TAKE_H

#include "microros/rcl_names_given.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_names_topic_t {
  const char * name; /* valid, as rmw_name_of_topic takes it */
} rcl_names_topic_t;

/* Takes a name that the application passes. */
static inline const char * rcl_names_take(
  rcl_names_topic_t * taken, const char * topic, const rmw_node_t * node)
{
  taken->name = topic;
  return rcl_names_given_topic(topic, node);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NAMES_TAKE_H */
