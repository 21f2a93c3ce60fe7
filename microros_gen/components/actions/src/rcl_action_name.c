/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/action_name.h"

#include "microros/text.h"

#include <string.h>

/* What ROS 2 appends to the name of an action for its goal service. */
static const char action_goal_part[] = "/_action/send_goal";

bool rcl_action_is_named(const char * full, const rmw_name_t * name)
{
  const size_t size = rmw_name_size(name);
  size_t at = 0;

  if (
    microros_text_size(full) != size + sizeof(action_goal_part) - 1u ||
    !microros_text_equals(&full[size], action_goal_part)) {
    return false;
  }
  for (size_t i = 0; i < sizeof(name->part) / sizeof(name->part[0]); ++i) {
    const size_t length = strlen(name->part[i]);

    if (memcmp(&full[at], name->part[i], length) != 0) {
      return false;
    }
    at += length;
  }
  return true;
}
