/* SPDX-License-Identifier: Apache-2.0 */
/* Expands names to fully qualified ones before they reach rmw. */
#include "microros/rcl_names_take.h"
#include "microros/rcl_names_expand.h"
#include "rcl/validate_topic_name.h"

#include <stddef.h>

const char * rcl_names_take(rcl_names_topic_t * taken, const char * topic, const rmw_node_t * node)
{
  const rcl_names_scope_t scope = {node->name, node->namespace_, NULL, NULL};
  int validation = RCL_TOPIC_NAME_INVALID_IS_EMPTY_STRING;
  size_t size;

  taken->name = taken->full;
  (void)rcl_validate_topic_name(topic, &validation, NULL);
  if (validation != RCL_TOPIC_NAME_VALID) {
    return rcl_topic_name_validation_result_string(validation);
  }
  size = rcl_names_expand(topic, &scope, taken->full, sizeof(taken->full));
  return size == 0u ? "an unknown substitution" : rcl_names_check_full(taken->full, size);
}
