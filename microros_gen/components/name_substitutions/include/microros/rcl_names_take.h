/* SPDX-License-Identifier: Apache-2.0 */
/* The name of a topic or service on its way down. In place of the file of the node. */
#ifndef MICROROS_RCL_NAMES_TAKE_H
#define MICROROS_RCL_NAMES_TAKE_H

#include "microros/rcl_names.h"
#include "microros/rcl_names_expand.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_names_topic_t {
  const char * name; /* valid, as rmw_name_of_topic takes it */
  char full[RCL_NAMES_FULL_SIZE];
} rcl_names_topic_t;

/* Takes a name that the application passes; *taken has to stay where it is. */
const char * rcl_names_take(rcl_names_topic_t * taken, const char * topic, const rmw_node_t * node);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NAMES_TAKE_H */
