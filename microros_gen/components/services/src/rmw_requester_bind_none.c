/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_service.h"

void rmw_requester_bind(const rmw_client_t * client, void * ros_response)
{
  (void)client;
  (void)ros_response;
}
