/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/init_options.h"

#include "microros/error.h"

#include <stddef.h>

rmw_ret_t rmw_uros_options_set_client_key(uint32_t client_key, rmw_init_options_t * rmw_options)
{
  if (rmw_options == NULL || client_key == 0u) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "client_key or rmw_options");
  }
  rmw_options->transport_params.client_key = client_key;
  return RMW_RET_OK;
}
