/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_transport.h"

#include <string.h>

bool rmw_transport_prepare(xrce_transport_t * transport, const rmw_uxrce_transport_params_t * params)
{
  (void)memset(transport, 0, sizeof(*transport));
  (void)params;
  return true;
}
