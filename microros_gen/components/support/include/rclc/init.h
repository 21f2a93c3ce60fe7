/* SPDX-License-Identifier: Apache-2.0 */
/* Opening and closing a session with rclc. */
#ifndef MICROROS_RCLC_INIT_H
#define MICROROS_RCLC_INIT_H

#include "microros_config.h"
#include "rcl/allocator.h"
#include "rcl/init_options.h"
#include "rclc/types.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Waits for the agent, at most MICROROS_CONNECT_TIMEOUT_MS; returns rcl_init's codes. `support` belongs to
 * the user and must outlive everything made with it; arguments are not read, `allocator` is stored and
 * never called.
 */
rcl_ret_t rclc_support_init(
  rclc_support_t * support, int argc, char const * const * argv, rcl_allocator_t * allocator);

/* Same with options, which are copied. */
rcl_ret_t rclc_support_init_with_options(
  rclc_support_t * support, int argc, char const * const * argv, rcl_init_options_t * init_options,
  rcl_allocator_t * allocator);

/*
 * Closes the session at the agent, waiting for at most MICROROS_CLOSE_TIMEOUT_MS; `support` can be
 * initialized again. */
rcl_ret_t rclc_support_fini(rclc_support_t * support);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_INIT_H */
