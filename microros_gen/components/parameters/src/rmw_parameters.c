/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_parameters.h"

#include "microros/lock.h"
#include "microros/xrce_parameters.h"
#include "microros/xrce_write_room.h"

#include <stddef.h>

bool rmw_parameters_have_room(const rmw_publisher_t * publisher)
{
  return publisher != NULL && xrce_write_has_room(publisher->data);
}

void rmw_parameters_answer_large(const rmw_service_t * service, uint8_t beginning)
{
  microros_lock();
  xrce_parameters_keep_beginning(service->data, beginning);
  microros_unlock();
}
