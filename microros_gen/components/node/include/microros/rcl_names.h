/* SPDX-License-Identifier: Apache-2.0 */
/* ROS 2's rules for names. Each function returns NULL, or the fault as a static text. */
#ifndef MICROROS_RCL_NAMES_H
#define MICROROS_RCL_NAMES_H

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

const char * rcl_names_check_node(const char * name);
const char * rcl_names_check_namespace(const char * namespace_);
const char * rcl_names_check_topic(const char * topic);

/* Same, including ROS 2's maximum length. Needed in an application without `nodes:`, whose names are not
 * known at build time. */
const char * rcl_names_check_node_size(const char * name);
const char * rcl_names_check_namespace_size(const char * namespace_);
const char * rcl_names_check_topic_size(const char * topic, const rmw_node_t * node);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NAMES_H */
