/* SPDX-License-Identifier: Apache-2.0 */
/* Everything of rcl that is selected. */
#ifndef MICROROS_RCL_RCL_H
#define MICROROS_RCL_RCL_H

#include "rcl/error_handling.h"
#include "rcl/guard_condition.h"
#include "rcl/init.h"
#include "rcl/init_options.h"
#include "rcl/node.h"
#include "rcl/subscription.h"
#include "rcl/time.h"
#include "rcl/wait.h"

#endif /* MICROROS_RCL_RCL_H */
