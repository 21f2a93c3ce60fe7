/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client.h"

#include "microros/lock.h"
#include "microros/xrce_client.h"

const char * const rmw_implementation_identifier = "rmw_microros_gen";

static xrce_client_t instance;

xrce_client_t * rmw_client_instance(void)
{
  return &instance;
}

uint32_t rmw_client_key(void)
{
  uint32_t result;

  microros_lock();
  result = instance.session.key;
  microros_unlock();
  return result;
}

uint32_t rmw_client_reconnects(void)
{
  uint32_t result;

  microros_lock();
  result = instance.session.statistics.reconnects;
  microros_unlock();
  return result;
}
