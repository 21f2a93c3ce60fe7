/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_service.h"

void rmw_replier_bind(const rmw_service_t * service, void * ros_request, void * ros_response)
{
  (void)service;
  (void)ros_request;
  (void)ros_response;
}
