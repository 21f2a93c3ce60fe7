/* SPDX-License-Identifier: Apache-2.0 */
/* Expansion of topic and service names passed by the application. Replaces the header of component `node`. */
#ifndef MICROROS_RCL_NAMES_TAKE_H
#define MICROROS_RCL_NAMES_TAKE_H

#include "microros/rcl_names.h"
#include "microros/rcl_names_expand.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_names_topic_t {
  const char * name; /* valid; for rmw_name_of_topic */
  char full[RCL_NAMES_FULL_SIZE];
} rcl_names_topic_t;

/* Expands a name passed by the application; *taken must stay at its address. */
const char * rcl_names_take(rcl_names_topic_t * taken, const char * topic, const rmw_node_t * node);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NAMES_TAKE_H */
