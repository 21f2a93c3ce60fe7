/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_transport.h"

#include "microros/error.h"
#include "microros_config.h"
#include "rmw_microros/init_options.h"

#include <string.h>

enum { LARGEST_ID = 0x1fffffff }; /* an extended identifier has 29 bits */

rmw_ret_t rmw_uros_options_set_can_device(const char * dev, uint32_t id, rmw_init_options_t * rmw_options)
{
  if (dev == NULL || rmw_options == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "dev or rmw_options");
  }
  if (dev[0] == '\0' || strlen(dev) >= RMW_UXRCE_MAX_CAN_DEVICE_SIZE) {
    microros_error_set(microros_error_can_device, dev, NULL, 0, RMW_UXRCE_MAX_CAN_DEVICE_SIZE - 1u);
    return RMW_RET_INVALID_ARGUMENT;
  }
  if (id == 0u || id > (uint32_t)LARGEST_ID) {
    microros_error_set(microros_error_can_id, NULL, NULL, id, 0);
    return RMW_RET_INVALID_ARGUMENT;
  }
  (void)memcpy(rmw_options->transport_params.can_device, dev, strlen(dev) + 1u);
  rmw_options->transport_params.can_id = id;
  return RMW_RET_OK;
}

bool rmw_transport_prepare(xrce_transport_t * transport, const rmw_uxrce_transport_params_t * params)
{
  (void)memset(transport, 0, sizeof(*transport));
  transport->device = params->can_device[0] != '\0' ? params->can_device : MICROROS_CAN_DEVICE;
  transport->id = params->can_id != 0u ? params->can_id : MICROROS_CAN_ID;
  return true;
}
