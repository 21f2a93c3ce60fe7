/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_modes.h"

#include "microros/lock.h"
#include "microros/rmw_node.h"
#include "microros/xrce_client.h"

uint8_t rmw_modes_get(const rmw_node_t * node)
{
  const xrce_client_t * client = node->context->impl;

  return client->modes[rmw_node_index(node)];
}

void rmw_modes_set(const rmw_node_t * node, uint8_t mode)
{
  xrce_client_t * client = node->context->impl;

  microros_lock();
  client->modes[rmw_node_index(node)] = mode;
  microros_unlock();
}
