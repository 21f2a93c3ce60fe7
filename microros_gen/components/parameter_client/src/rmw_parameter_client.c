/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_parameter_client.h"

#include "microros/lock.h"
#include "microros/xrce_parameters.h"

void rmw_parameter_client_keep_beginning(const rmw_subscription_t * subscription, uint8_t size)
{
  microros_lock();
  xrce_parameters_keep_beginning(subscription->data, size);
  microros_unlock();
}
