/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/action_name.h"

#include "microros/text.h"

#include <stddef.h>

/* What ROS 2 appends to the name of an action for its goal service. */
static const char action_goal_part[] = "/_action/send_goal";

bool rcl_action_is_named(const char * full, const rmw_name_t * name)
{
  size_t at = 0;

  for (size_t i = 0; i < sizeof(name->part) / sizeof(name->part[0]); ++i) {
    for (size_t from = 0; name->part[i][from] != '\0'; ++from) {
      if (full[at] != name->part[i][from]) {
        return false; /* also at the end of `full` */
      }
      ++at;
    }
  }
  return microros_text_equals(&full[at], action_goal_part);
}
