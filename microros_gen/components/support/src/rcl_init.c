/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/init.h"

#include "microros/error.h"

#include <stddef.h>

rcl_ret_t rcl_init(
  int argc, char const * const * argv, const rcl_init_options_t * options, rcl_context_t * context)
{
  static rmw_context_t the_context; /* one session, so one context: what rcl_context_t.impl points to */
  rcl_ret_t result;

  (void)argc;
  (void)argv;
  if (options == NULL || context == NULL) {
    microros_error_set(MICROROS_ERROR_ARGUMENT, "options or context", NULL, 0, 0);
    return RCL_RET_INVALID_ARGUMENT;
  }
  if (context->impl != NULL) {
    microros_error_set(MICROROS_ERROR_CONTEXT_IN_USE, NULL, NULL, 0, 0);
    return RCL_RET_ALREADY_INIT;
  }
  result = rmw_init(&options->rmw, &the_context);
  if (result == RCL_RET_OK) {
    context->impl = &the_context;
  }
  return result;
}

rcl_ret_t rcl_shutdown(rcl_context_t * context)
{
  if (context == NULL || context->impl == NULL) {
    microros_error_set(MICROROS_ERROR_ARGUMENT, "context", NULL, 0, 0);
    return RCL_RET_INVALID_ARGUMENT;
  }
  if (!rcl_context_is_valid(context)) {
    return RCL_RET_ALREADY_SHUTDOWN;
  }
  return rmw_shutdown(context->impl);
}
