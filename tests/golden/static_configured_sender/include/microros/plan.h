/* SPDX-License-Identifier: Apache-2.0 */
/* What the application file declares, as constant tables; only where it has `nodes:`. */
#ifndef MICROROS_PLAN_H
#define MICROROS_PLAN_H

#include <stdint.h>

#include "microros_config.h"

typedef struct microros_declared_node_t {
  const char * name;
  const char * namespace_; /* "/" or "/a/b" */
  uint16_t domain_id;
} microros_declared_node_t;

typedef struct microros_declared_publisher_t {
  const char * topic;    /* fully qualified */
  const char * dds_type; /* "std_msgs::msg::dds_::Int32_" */
  uint16_t node;         /* index of its node */
} microros_declared_publisher_t;

extern const microros_declared_node_t microros_declared_nodes[MICROROS_NODES_MAX];
extern const microros_declared_publisher_t microros_declared_publishers[MICROROS_PUBLISHERS_MAX];

#endif /* MICROROS_PLAN_H */
