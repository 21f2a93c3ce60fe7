/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of the application file as constant tables; only with `nodes:`. */
#ifndef MICROROS_PLAN_H
#define MICROROS_PLAN_H

#include <stdint.h>

#include "microros/flash.h"
#include "microros/xrce_objects.h"
#include "microros_config.h"

typedef struct microros_declared_node_t {
  const char * name;
  const char * namespace_; /* "/" or "/a/b" */
  uint16_t domain_id;
} microros_declared_node_t;

typedef struct microros_declared_endpoint_t {
  const char * name;     /* fully qualified */
  const MICROROS_FLASH char * dds_type; /* "std_msgs::msg::dds_::Int32_"; of a service: its service type */
  uint16_t node;         /* index of its node */
} microros_declared_endpoint_t;

extern const MICROROS_FLASH microros_declared_node_t microros_declared_nodes[MICROROS_NODES_MAX];

/* In the order of their places: publishers, subscriptions, services, clients. */
extern const MICROROS_FLASH microros_declared_endpoint_t microros_declared_endpoints[XRCE_ENDPOINTS];

/* The names in the source code: without `remap:` the same as on the wire. */
static inline const char * microros_declared_node_name(const MICROROS_FLASH microros_declared_node_t * node)
{
  return node->name;
}

static inline const char * microros_declared_node_namespace(const MICROROS_FLASH microros_declared_node_t * node)
{
  return node->namespace_;
}

static inline const char * microros_declared_name(const MICROROS_FLASH microros_declared_endpoint_t * endpoint)
{
  return endpoint->name;
}

#endif /* MICROROS_PLAN_H */
