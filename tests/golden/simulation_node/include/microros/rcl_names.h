/* SPDX-License-Identifier: Apache-2.0 */
/* The rules of ROS 2 for names. Each returns NULL, or what is wrong, as a static text. */
#ifndef MICROROS_RCL_NAMES_H
#define MICROROS_RCL_NAMES_H

#ifdef __cplusplus
extern "C" {
#endif

const char * rcl_names_check_node(const char * name);
const char * rcl_names_check_namespace(const char * namespace_);
const char * rcl_names_check_topic(const char * topic);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NAMES_H */
