/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/context.h"

#include "microros/error.h"

#include <stddef.h>

rcl_arguments_t rcl_get_zero_initialized_arguments(void)
{
  const rcl_arguments_t arguments = {NULL};

  return arguments;
}

rcl_context_t rcl_get_zero_initialized_context(void)
{
  const rcl_context_t context = {{NULL}, NULL};

  return context;
}

rcl_ret_t rcl_context_fini(rcl_context_t * context)
{
  if (context == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "context");
  }
  if (rcl_context_is_valid(context)) {
    return microros_error_named(RCL_RET_INVALID_ARGUMENT, microros_error_context_in_use, NULL);
  }
  context->impl = NULL;
  return RCL_RET_OK;
}

rcl_context_instance_id_t rcl_context_get_instance_id(const rcl_context_t * context)
{
  return rcl_context_is_valid(context) ? context->impl->instance_id : 0u;
}

rcl_ret_t rcl_context_get_domain_id(rcl_context_t * context, size_t * domain_id)
{
  if (domain_id == NULL || !rcl_context_is_valid(context)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "context or domain_id");
  }
  *domain_id = context->impl->actual_domain_id;
  return RCL_RET_OK;
}

bool rcl_context_is_valid(const rcl_context_t * context)
{
  return context != NULL && context->impl != NULL && context->impl->impl != NULL;
}

rmw_context_t * rcl_context_get_rmw_context(rcl_context_t * context)
{
  return rcl_context_is_valid(context) ? context->impl : NULL;
}
