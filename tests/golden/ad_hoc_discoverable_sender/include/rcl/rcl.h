/* SPDX-License-Identifier: Apache-2.0 */
/* Everything of rcl that is selected. */
#ifndef MICROROS_RCL_RCL_H
#define MICROROS_RCL_RCL_H

#include "rcl/error_handling.h"
#include "rcl/init.h"
#include "rcl/init_options.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/time.h"

#endif /* MICROROS_RCL_RCL_H */
