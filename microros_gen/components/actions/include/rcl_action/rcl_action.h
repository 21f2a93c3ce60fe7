/* SPDX-License-Identifier: Apache-2.0 */
/* Everything of rcl_action that this library has. */
#ifndef MICROROS_RCL_ACTION_RCL_ACTION_H
#define MICROROS_RCL_ACTION_RCL_ACTION_H

#include "rcl_action/default_qos.h"
#include "rcl_action/goal_state_machine.h"
#include "rcl_action/types.h"

#endif /* MICROROS_RCL_ACTION_RCL_ACTION_H */
