/* SPDX-License-Identifier: Apache-2.0 */
/* Names of loggers of nodes, with room for the longest one. An image has that room only if the function is called. */
#include "microros/lock.h"
#include "microros/rmw_node.h"
#include "microros/xrce_client.h"
#include "rcl/node.h"

#include <stddef.h>

/* Writes `namespace.name`, of a namespace that begins with a slash; one `/` separates others. */
static void logger_name_write(char * text, const char * namespace_, const char * name)
{
  size_t used = 0;

  for (const char * next = &namespace_[1]; *next != '\0' && used + 1u < MICROROS_NODE_LOGGER_NAME_SIZE;
       ++next) {
    text[used] = *next == '/' ? '.' : *next;
    ++used;
  }
  text[used] = '.';
  for (const char * next = name; *next != '\0' && used + 2u < MICROROS_NODE_LOGGER_NAME_SIZE; ++next) {
    ++used;
    text[used] = *next;
  }
  text[used + 1u] = '\0';
}

const char * rcl_node_get_logger_name(const rcl_node_t * node)
{
  static char names[MICROROS_NODES_MAX][MICROROS_NODE_LOGGER_NAME_SIZE];
  char * text = NULL;

  if (!rcl_node_is_valid(node)) {
    return NULL;
  }
  if (node->impl->namespace_[1] == '\0') {
    return node->impl->name;
  }
  microros_lock();
  text = names[rmw_node_index(node->impl)];
  logger_name_write(text, node->impl->namespace_, node->impl->name);
  microros_unlock();
  return text;
}
