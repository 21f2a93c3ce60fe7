/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw/init_options.h"

#include "microros/error.h"
#include "microros/rmw_client.h"

#include <string.h>

rmw_init_options_t rmw_get_zero_initialized_init_options(void)
{
  rmw_init_options_t options;

  (void)memset(&options, 0, sizeof(options));
  return options;
}

rmw_ret_t rmw_init_options_init(rmw_init_options_t * init_options, rcutils_allocator_t allocator)
{
  if (init_options == NULL || init_options->implementation_identifier != NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "init_options");
  }
  (void)memset(init_options, 0, sizeof(*init_options));
  init_options->implementation_identifier = rmw_implementation_identifier;
  init_options->domain_id = RMW_DEFAULT_DOMAIN_ID;
  init_options->allocator = allocator;
  return RMW_RET_OK;
}

rmw_ret_t rmw_init_options_copy(const rmw_init_options_t * src, rmw_init_options_t * dst)
{
  if (
    src == NULL || dst == NULL || src->implementation_identifier == NULL ||
    dst->implementation_identifier != NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "init_options");
  }
  *dst = *src;
  return RMW_RET_OK;
}

rmw_ret_t rmw_init_options_fini(rmw_init_options_t * init_options)
{
  if (init_options == NULL || init_options->implementation_identifier == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "init_options");
  }
  init_options->implementation_identifier = NULL;
  return RMW_RET_OK;
}
