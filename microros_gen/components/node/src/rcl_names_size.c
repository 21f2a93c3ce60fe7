/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_names.h"
#include "microros/rmw_names.h"
#include "microros/text.h"

#include <stddef.h>

/* ROS 2's RMW_NODE_NAME_MAX_NAME_LENGTH, RMW_NAMESPACE_MAX_LENGTH, RMW_TOPIC_MAX_NAME_LENGTH. */
enum { NODE_MOST = 255, NAMESPACE_MOST = 245, TOPIC_MOST = 247 };

static const char * names_check_size(const char * fault, size_t size, size_t most)
{
  return fault == NULL && size > most ? "longer than ROS 2 has names" : fault;
}

const char * rcl_names_check_node_size(const char * name)
{
  return names_check_size(rcl_names_check_node(name), microros_text_size(name), NODE_MOST);
}

const char * rcl_names_check_namespace_size(const char * namespace_)
{
  const rmw_name_t full = rmw_name_of_namespace(namespace_);

  return names_check_size(rcl_names_check_namespace(namespace_), rmw_name_size(&full), NAMESPACE_MOST);
}

const char * rcl_names_check_topic_size(const char * topic, const rmw_node_t * node)
{
  const rmw_name_t full = rmw_name_of_topic(topic, node->name, node->namespace_);

  return names_check_size(rcl_names_check_topic(topic), rmw_name_size(&full), TOPIC_MOST);
}
