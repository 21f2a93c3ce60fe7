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

void rmw_parameters_answer_large(const rmw_service_t * service, bool answers)
{
  microros_lock();
  xrce_parameters_keep_beginning(service->data, answers ? (uint8_t)XRCE_PARAMETERS_BEGINNING : 0u);
  microros_unlock();
}
