/* SPDX-License-Identifier: Apache-2.0 */
/* All selected headers of rcl, and those that ROS 2's rcl.h includes: sources rely on that. */
#ifndef MICROROS_RCL_RCL_H
#define MICROROS_RCL_RCL_H

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rcl/error_handling.h"
#include "rcl/guard_condition.h"
#include "rcl/init.h"
#include "rcl/init_options.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/subscription.h"
#include "rcl/time.h"
#include "rcl/wait.h"
#include "rcutils/snprintf.h"
#include "rcutils/types.h"
#include "rmw/rmw.h"
#include "rosidl_runtime_c/primitives_sequence.h"
#include "rosidl_runtime_c/string.h"

#endif /* MICROROS_RCL_RCL_H */
