/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client.h"

#include "microros/xrce_client.h"

const char * const rmw_implementation_identifier = "rmw_microros_gen";

static xrce_client_t instance;

xrce_client_t * rmw_client_instance(void)
{
  return &instance;
}
