/* SPDX-License-Identifier: Apache-2.0 */
/* Types shared by all functions of rclc. */
#ifndef MICROROS_RCLC_TYPES_H
#define MICROROS_RCLC_TYPES_H

#include "rcl/allocator.h"
#include "rcl/context.h"
#include "rcl/time.h"

typedef struct {
  rcl_context_t context;
  rcl_allocator_t * allocator;
  rcl_clock_t clock;
} rclc_support_t;

#define RCLC_UNUSED(x) (void)(x)

#endif /* MICROROS_RCLC_TYPES_H */
