/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_node_endpoints.h"

#include "microros/rmw_node.h"
#include "microros/xrce_objects.h"

bool rmw_node_has_endpoint(const rmw_node_t * node, const void * endpoint)
{
  const xrce_endpoint_t * place = endpoint;

  return place->participant == rmw_node_index(node);
}
