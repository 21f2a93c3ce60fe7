/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/lock.h"
#include "microros/rclc_parameter_client.h"
#include "microros/rmw_service.h"
#include "microros/xrce_read.h"

uint16_t rclc_parameter_client_take_large(const rclc_parameter_client_t * client, uint16_t * fits)
{
  const rmw_client_t * requester = client->services[client->call].impl;
  uint16_t large;

  microros_lock();
  large = xrce_read_large(requester->data, fits);
  microros_unlock();
  return large;
}
