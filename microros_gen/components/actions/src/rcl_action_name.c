/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/action_name.h"

#include "microros/text.h"

#include <stddef.h>

bool rcl_action_is_named(const char * full, const rmw_name_t * name)
{
  static const char goal_part[] = "/_action/send_goal"; /* what ROS 2 appends for the goal service */
  size_t at = 0;

  for (size_t i = 0; i < sizeof(name->part) / sizeof(name->part[0]); ++i) {
    for (size_t from = 0; name->part[i][from] != '\0'; ++from) {
      if (full[at] != name->part[i][from]) {
        return false; /* also at the end of `full` */
      }
      ++at;
    }
  }
  return microros_text_equals(&full[at], goal_part);
}
