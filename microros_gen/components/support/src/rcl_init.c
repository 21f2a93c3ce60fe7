/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/init.h"

#include "microros/error.h"
#include "microros/rcl_open.h"
#include "microros/rmw_open.h"

#include <stddef.h>

static rmw_context_t the_context; /* one session, therefore one context: target of rcl_context_t.impl */

rcl_ret_t rcl_open(const rmw_init_options_t * options, rcl_context_t * context)
{
  const rcl_ret_t result = rmw_init(options, &the_context);

  if (result == RCL_RET_OK) {
    context->impl = &the_context;
  }
  return result;
}

rcl_ret_t rcl_open_as_planned(rcl_context_t * context)
{
  const rcl_ret_t result = rmw_open_as_planned(&the_context);

  if (result == RCL_RET_OK) {
    context->impl = &the_context;
  }
  return result;
}

rcl_ret_t rcl_init(
  int argc, char const * const * argv, const rcl_init_options_t * options, rcl_context_t * context)
{
  (void)argc;
  (void)argv;
  if (options == NULL || context == NULL || options->rmw.implementation_identifier == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "options or context");
  }
  if (context->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_context_in_use, NULL);
  }
  return rcl_open(&options->rmw, context);
}

rcl_ret_t rcl_shutdown(rcl_context_t * context)
{
  if (context == NULL || context->impl == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "context");
  }
  if (!rcl_context_is_valid(context)) {
    return RCL_RET_ALREADY_SHUTDOWN;
  }
  return rmw_shutdown(context->impl);
}
