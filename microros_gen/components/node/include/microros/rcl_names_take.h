/* SPDX-License-Identifier: Apache-2.0 */
/* Topic and service names passed by the application. A component with substitutions replaces this header. */
#ifndef MICROROS_RCL_NAMES_TAKE_H
#define MICROROS_RCL_NAMES_TAKE_H

#include "microros/rcl_names_given.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_names_topic_t {
  const char * name; /* valid; for rmw_name_of_topic */
} rcl_names_topic_t;

/* Stores a name passed by the application. */
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
