/* SPDX-License-Identifier: Apache-2.0 */
/* The rules of ROS 2 for names. Each function returns NULL, or what is wrong, as a static text. */
#ifndef MICROROS_RCL_NAMES_H
#define MICROROS_RCL_NAMES_H

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

const char * rcl_names_check_node(const char * name);
const char * rcl_names_check_namespace(const char * namespace_);
const char * rcl_names_check_topic(const char * topic);

/* The name of a topic or service on its way down. */
typedef struct rcl_names_topic_t {
  const char * name; /* valid, as rmw_name_of_topic takes it */
} rcl_names_topic_t;

/* Takes a name that the application passes. */
static inline const char * rcl_names_take(
  rcl_names_topic_t * taken, const char * topic, const rmw_node_t * node)
{
  taken->name = topic;
  (void)node;
  return rcl_names_check_topic(topic);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NAMES_H */
