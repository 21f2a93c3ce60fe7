/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_action_server.h"

#include "microros/lock.h"
#include "microros/xrce_client.h"
#include "microros/xrce_parameters.h"
#include "microros/xrce_write_room.h"

#include <stddef.h>

bool rmw_action_server_may_reply(const rmw_service_t * service)
{
  return xrce_write_has_room(service->data);
}

bool rmw_action_server_may_publish(const rmw_publisher_t * publisher)
{
  return xrce_write_has_room(publisher->data);
}

void rmw_action_server_answer_large(const rmw_service_t * service)
{
  microros_lock();
  xrce_parameters_keep_beginning(service->data, (uint8_t)XRCE_PARAMETERS_BEGINNING);
  microros_unlock();
}
