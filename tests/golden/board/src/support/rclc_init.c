/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/init.h"

#include "microros/error.h"
#include "microros/port.h"
#include "microros/rcl_open.h"
#include "rcl/init.h"
#include "rclc/sleep.h"

#include <string.h>

static rcl_ret_t support_prepare(rclc_support_t * support, rcl_allocator_t * allocator)
{
  rcl_ret_t result = RCL_RET_OK;

  if (support == NULL || allocator == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "support or allocator");
  }
  (void)memset(support, 0, sizeof(*support));
  support->allocator = allocator;
  return result;
}

rcl_ret_t rclc_support_init_with_options(
  rclc_support_t * support, int argc, char const * const * argv, rcl_init_options_t * init_options,
  rcl_allocator_t * allocator)
{
  rcl_ret_t result;

  (void)argc;
  (void)argv;
  if (init_options == NULL || init_options->rmw.implementation_identifier == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "init_options");
  }
  result = support_prepare(support, allocator);
  return result == RCL_RET_OK ? rcl_open(&init_options->rmw, &support->context) : result;
}

rcl_ret_t rclc_support_init(
  rclc_support_t * support, int argc, char const * const * argv, rcl_allocator_t * allocator)
{
  const rcl_ret_t result = support_prepare(support, allocator);

  (void)argc;
  (void)argv;
  return result == RCL_RET_OK ? rcl_open_as_planned(&support->context) : result;
}

rcl_ret_t rclc_support_fini(rclc_support_t * support)
{
  rcl_ret_t result;
  rcl_ret_t fini;

  if (support == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "support");
  }
  result = rcl_shutdown(&support->context);
  fini = rcl_context_fini(&support->context);
  return result == RCL_RET_OK && fini == RCL_RET_OK ? RCL_RET_OK : RCL_RET_ERROR;
}

void rclc_sleep_ms(unsigned int ms)
{
  port_sleep_ms(ms);
}
