/* SPDX-License-Identifier: Apache-2.0 */
/* All selected headers of rclc, except for the executor. */
#ifndef MICROROS_RCLC_RCLC_H
#define MICROROS_RCLC_RCLC_H

#include "rcl/rcl.h"
#include "rclc/init.h"
#include "rclc/node.h"
#include "rclc/publisher.h"
#include "rclc/sleep.h"
#include "rclc/subscription.h"
#include "rclc/types.h"

#endif /* MICROROS_RCLC_RCLC_H */
