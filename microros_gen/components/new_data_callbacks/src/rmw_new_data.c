/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_new_data.h"

#include "microros/lock.h"
#include "microros/xrce_new_data.h"

void rmw_new_data_set(const void * endpoint, rmw_event_callback_t callback, const void * user_data)
{
  microros_lock();
  xrce_new_data_set(endpoint, callback, user_data);
  microros_unlock();
}
