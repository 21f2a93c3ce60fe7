/* SPDX-License-Identifier: Apache-2.0 */
/* All selected headers of rmw_microros. */
#ifndef MICROROS_RMW_MICROROS_RMW_MICROROS_H
#define MICROROS_RMW_MICROROS_RMW_MICROROS_H

#include "rcutils/error_handling.h"
#include "rcutils/types.h"
#include "rmw/rmw.h"
#include "rmw_microxrcedds_c/config.h"
#include "rmw_microros/init_options.h"
#include "rmw_microros/message_memory.h"
#include "rmw_microros/session.h"
#include "rmw_microros/timing.h"

#endif /* MICROROS_RMW_MICROROS_RMW_MICROROS_H */
