/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/init.h"

#include "microros/error.h"
#include "rcl/init.h"

#include <string.h>

rcl_ret_t rclc_support_init_with_options(
  rclc_support_t * support, int argc, char const * const * argv, rcl_init_options_t * init_options,
  rcl_allocator_t * allocator)
{
  if (support == NULL || init_options == NULL || allocator == NULL) {
    microros_error_set(MICROROS_ERROR_ARGUMENT, "support, init_options or allocator", NULL, 0, 0);
    return RCL_RET_INVALID_ARGUMENT;
  }
  memset(support, 0, sizeof(*support));
  support->allocator = allocator;
  return rcl_init(argc, argv, init_options, &support->context);
}

rcl_ret_t rclc_support_init(
  rclc_support_t * support, int argc, char const * const * argv, rcl_allocator_t * allocator)
{
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  rcl_ret_t result;

  if (allocator == NULL) {
    microros_error_set(MICROROS_ERROR_ARGUMENT, "allocator", NULL, 0, 0);
    return RCL_RET_INVALID_ARGUMENT;
  }
  result = rcl_init_options_init(&options, *allocator);
  if (result != RCL_RET_OK) {
    return result;
  }
  return rclc_support_init_with_options(support, argc, argv, &options, allocator);
}

rcl_ret_t rclc_support_fini(rclc_support_t * support)
{
  rcl_ret_t result;
  rcl_ret_t fini;

  if (support == NULL) {
    microros_error_set(MICROROS_ERROR_ARGUMENT, "support", NULL, 0, 0);
    return RCL_RET_INVALID_ARGUMENT;
  }
  result = rcl_shutdown(&support->context);
  fini = rcl_context_fini(&support->context);
  return result != RCL_RET_OK ? result : fini;
}
