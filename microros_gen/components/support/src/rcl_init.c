/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/init.h"

#include "microros/error.h"
#include "microros/rcl_open.h"
#include "microros/rmw_open.h"
#include "rcl/context.h"
#include "rcl/domain_id.h"
#include "rcl/init_options.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* UDP ports of higher domains would exceed 65535 (RTPS 2.5, 9.6.1.1). */
enum {
  DOMAIN_MOST = 232,
  DOMAIN_OF_AGENT = 255 /* a convention of the public client and agent */
};

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

static bool options_are_valid(const rcl_init_options_t * init_options)
{
  if (init_options == NULL || init_options->rmw.implementation_identifier == NULL) {
    microros_error_set(microros_error_argument, "init_options", NULL, 0, 0);
    return false;
  }
  return true;
}

rcl_init_options_t rcl_get_zero_initialized_init_options(void)
{
  rcl_init_options_t options;

  (void)memset(&options, 0, sizeof(options));
  return options;
}

rcl_ret_t rcl_init_options_init(rcl_init_options_t * init_options, rcl_allocator_t allocator)
{
  if (init_options != NULL && init_options->rmw.implementation_identifier != NULL) {
    return microros_error_refuse(RCL_RET_ALREADY_INIT, "init_options");
  }
  return rmw_init_options_init(init_options != NULL ? &init_options->rmw : NULL, allocator);
}

rcl_ret_t rcl_init_options_copy(const rcl_init_options_t * src, rcl_init_options_t * dst)
{
  if (dst == NULL || !options_are_valid(src)) {
    return RCL_RET_INVALID_ARGUMENT;
  }
  if (dst->rmw.implementation_identifier != NULL) {
    return microros_error_refuse(RCL_RET_ALREADY_INIT, "dst");
  }
  return rmw_init_options_copy(&src->rmw, &dst->rmw);
}

rcl_ret_t rcl_init_options_fini(rcl_init_options_t * init_options)
{
  if (!options_are_valid(init_options)) {
    return RCL_RET_INVALID_ARGUMENT;
  }
  return rmw_init_options_fini(&init_options->rmw);
}

rcl_ret_t rcl_init_options_get_domain_id(const rcl_init_options_t * init_options, size_t * domain_id)
{
  if (domain_id == NULL || !options_are_valid(init_options)) {
    return RCL_RET_INVALID_ARGUMENT;
  }
  *domain_id = init_options->rmw.domain_id;
  return RCL_RET_OK;
}

rcl_ret_t rcl_init_options_set_domain_id(rcl_init_options_t * init_options, size_t domain_id)
{
  if (!options_are_valid(init_options)) {
    return RCL_RET_INVALID_ARGUMENT;
  }
  if (domain_id != RCL_DEFAULT_DOMAIN_ID && domain_id > DOMAIN_MOST && domain_id != DOMAIN_OF_AGENT) {
    microros_error_set(microros_error_domain, NULL, NULL, (uint32_t)domain_id, DOMAIN_MOST);
    return RCL_RET_INVALID_ARGUMENT;
  }
  init_options->rmw.domain_id = domain_id;
  return RCL_RET_OK;
}

rmw_init_options_t * rcl_init_options_get_rmw_init_options(rcl_init_options_t * init_options)
{
  return options_are_valid(init_options) ? &init_options->rmw : NULL;
}

const rcl_allocator_t * rcl_init_options_get_allocator(const rcl_init_options_t * init_options)
{
  return options_are_valid(init_options) ? &init_options->rmw.allocator : NULL;
}

/* cppcheck-suppress constParameter ; the signature is that of ROS 2 */
rcl_ret_t rcl_get_default_domain_id(size_t * domain_id)
{
  if (domain_id == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "domain_id");
  }
  return RCL_RET_OK;
}

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
