/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_transport.h"

#include "microros/error.h"
#include "microros_config.h"
#include "rmw_microros/init_options.h"

#include <string.h>

rmw_ret_t rmw_uros_options_set_serial_device(const char * dev, rmw_init_options_t * rmw_options)
{
  if (dev == NULL || rmw_options == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "dev or rmw_options");
  }
  if (dev[0] == '\0' || strlen(dev) >= RMW_UXRCE_MAX_SERIAL_DEVICE_SIZE) {
    microros_error_set(microros_error_device, dev, NULL, 0, RMW_UXRCE_MAX_SERIAL_DEVICE_SIZE - 1u);
    return RMW_RET_INVALID_ARGUMENT;
  }
  (void)memcpy(rmw_options->transport_params.serial_device, dev, strlen(dev) + 1u);
  return RMW_RET_OK;
}

bool rmw_transport_prepare(xrce_transport_t * transport, const rmw_uxrce_transport_params_t * params)
{
  (void)memset(transport, 0, sizeof(*transport));
  transport->device = params->serial_device[0] != '\0' ? params->serial_device : MICROROS_SERIAL_DEVICE;
  return true;
}
