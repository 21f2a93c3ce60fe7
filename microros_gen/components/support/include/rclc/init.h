/* SPDX-License-Identifier: Apache-2.0 */
/* Start and end of a session, the short way. */
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
 * Waits for the agent, at most MICROROS_CONNECT_TIMEOUT_MS, and fails with rcl_init's codes. `support` is the
 * user's and must outlive everything made with it; arguments are not read, `allocator` is kept and not
 * called.
 */
rcl_ret_t rclc_support_init(
  rclc_support_t * support, int argc, char const * const * argv, rcl_allocator_t * allocator);

/* The same with options; they are copied. */
rcl_ret_t rclc_support_init_with_options(
  rclc_support_t * support, int argc, char const * const * argv, rcl_init_options_t * init_options,
  rcl_allocator_t * allocator);

/* Takes leave of the agent, at most MICROROS_CLOSE_TIMEOUT_MS; `support` can be initialized again. */
rcl_ret_t rclc_support_fini(rclc_support_t * support);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_INIT_H */
