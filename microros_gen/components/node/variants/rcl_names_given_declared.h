/* SPDX-License-Identifier: Apache-2.0 */
/* Rules for a name passed by the application. Each function returns NULL, or the fault as a static text. */
#ifndef MICROROS_RCL_NAMES_GIVEN_H
#define MICROROS_RCL_NAMES_GIVEN_H

#include "microros/rcl_names.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline const char * rcl_names_given_node(const char * name)
{
  return rcl_names_check_node(name);
}

static inline const char * rcl_names_given_namespace(const char * namespace_)
{
  return rcl_names_check_namespace(namespace_);
}

static inline const char * rcl_names_given_topic(const char * topic, const rmw_node_t * node)
{
  (void)node;
  return rcl_names_check_topic(topic);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NAMES_GIVEN_H */
