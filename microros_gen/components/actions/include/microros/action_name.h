/* SPDX-License-Identifier: Apache-2.0 */
/* Names of actions and of their services. Internal. */
#ifndef MICROROS_ACTION_NAME_H
#define MICROROS_ACTION_NAME_H

#include <stdbool.h>

#include "microros/rmw_names.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether `full` is the name of the goal service of the action `name`. */
bool rcl_action_is_named(const char * full, const rmw_name_t * name);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ACTION_NAME_H */
