/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/node_options.h"

#include "microros/error.h"

#include <string.h>

rcl_node_options_t rcl_node_get_default_options(void)
{
  rcl_node_options_t options;

  (void)memset(&options, 0, sizeof(options));
  options.allocator = rcl_get_default_allocator();
  options.use_global_arguments = true;
  return options;
}

rcl_ret_t rcl_node_options_copy(const rcl_node_options_t * options, rcl_node_options_t * options_out)
{
  if (options == NULL || options_out == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "options");
  }
  *options_out = *options;
  return RCL_RET_OK;
}

rcl_ret_t rcl_node_options_fini(rcl_node_options_t * options)
{
  if (options == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "options");
  }
  return RCL_RET_OK;
}
