/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/node_options.h"

#include "microros/error.h"

#include <string.h>

rcl_node_options_t rcl_node_get_default_options(void)
{
  rcl_node_options_t options;

  memset(&options, 0, sizeof(options));
  options.allocator = rcl_get_default_allocator();
  options.use_global_arguments = true;
  return options;
}

rcl_ret_t rcl_node_options_copy(const rcl_node_options_t * options, rcl_node_options_t * options_out)
{
  if (options == NULL || options_out == NULL) {
    microros_error_set(MICROROS_ERROR_ARGUMENT, "options", NULL, 0, 0);
    return RCL_RET_INVALID_ARGUMENT;
  }
  *options_out = *options;
  return RCL_RET_OK;
}

rcl_ret_t rcl_node_options_fini(rcl_node_options_t * options)
{
  if (options == NULL) {
    microros_error_set(MICROROS_ERROR_ARGUMENT, "options", NULL, 0, 0);
    return RCL_RET_INVALID_ARGUMENT;
  }
  return RCL_RET_OK;
}
