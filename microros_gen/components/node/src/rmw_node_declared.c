/* SPDX-License-Identifier: Apache-2.0 */
/* `nodes:` is in the application file: only declared nodes can be opened, and the names are constants. */
#include "microros/rmw_node.h"

#include "microros/error.h"
#include "microros/plan.h"
#include "microros/rmw_names.h"
#include "microros/text.h"
#include "microros/xrce_client.h"

uint16_t rmw_node_take(xrce_client_t * client, const char * name, const char * namespace_)
{
  const rmw_name_t wanted = rmw_name_of_namespace(namespace_);
  microros_error_t error = microros_error_node_undeclared;

  for (uint16_t i = 0; i < MICROROS_NODES_MAX; ++i) {
    const MICROROS_FLASH microros_declared_node_t * declared = &microros_declared_nodes[i];
    xrce_participant_t * participant = &client->participants[i];

    if (
      !microros_text_equals(microros_declared_node_name(declared), name) ||
      !rmw_name_equals(&wanted, microros_declared_node_namespace(declared))) {
      continue;
    }
    if (xrce_place_is_free(&client->states[i])) {
      participant->name = declared->name;
      participant->namespace_ = declared->namespace_;
      participant->domain_id = declared->domain_id;
      return i;
    }
    error = microros_error_node_open;
  }
  microros_error_set(error, name, namespace_, 0, 0);
  return RMW_NO_PLACE;
}
