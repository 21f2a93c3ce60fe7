/* SPDX-License-Identifier: Apache-2.0 */
/* No `nodes:` in the application file: any node uses one of `pools: {nodes: N}`. */
#include "microros/rmw_node.h"

#include "microros/error.h"
#include "microros/rmw_names.h"
#include "microros/text.h"
#include "microros/xrce_client.h"

#include <string.h>

typedef struct node_names_t {
  char name[MICROROS_NAME_SIZE];
  char namespace_[MICROROS_NAME_SIZE];
} node_names_t;

static bool node_fits(const char * text, size_t size)
{
  if (size < MICROROS_NAME_SIZE) {
    return true;
  }
  microros_error_set(microros_error_name_long, text, NULL, (uint32_t)size, (uint32_t)size + 1u);
  return false;
}

uint16_t rmw_node_take(xrce_client_t * client, const char * name, const char * namespace_)
{
  static node_names_t names[MICROROS_NODES_MAX];
  const rmw_name_t expanded = rmw_name_of_namespace(namespace_);

  if (!node_fits(name, microros_text_size(name)) || !node_fits(namespace_, rmw_name_size(&expanded))) {
    return RMW_NO_PLACE;
  }
  for (uint16_t i = 0; i < MICROROS_NODES_MAX; ++i) {
    xrce_participant_t * participant = &client->participants[i];

    if (xrce_place_is_free(&client->states[i])) {
      (void)memcpy(names[i].name, name, microros_text_size(name) + 1u);
      rmw_name_copy(&expanded, names[i].namespace_);
      participant->name = names[i].name;
      participant->namespace_ = names[i].namespace_;
      participant->domain_id = 0;
      return i;
    }
  }
  microros_error_set(
    microros_error_of_pool(microros_error_nodes_full, MICROROS_NODES_MAX), name, NULL, MICROROS_NODES_MAX,
    MICROROS_NODES_MAX + 1u);
  return RMW_NO_PLACE;
}
