/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_parameters.h"

#include "microros/lock.h"
#include "microros/xrce_parameters.h"
#include "microros/xrce_write.h"

#include <stddef.h>

bool rmw_parameters_have_room(const rmw_publisher_t * publisher)
{
  bool result;

  if (publisher == NULL) {
    return false;
  }
  microros_lock();
  result = xrce_write_reserve(publisher->data) != NULL;
  microros_unlock();
  return result;
}

void rmw_parameters_answer_large(const rmw_service_t * service, uint8_t beginning)
{
  microros_lock();
  xrce_parameters_keep_beginning(service->data, beginning);
  microros_unlock();
}
