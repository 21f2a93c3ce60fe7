/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_deadlines.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"

#include <stddef.h>
#include <string.h>

xrce_deadline_t * rmw_deadline_open(const void * endpoint)
{
  xrce_deadline_t * deadline;

  microros_lock();
  deadline = xrce_deadline_open(endpoint);
  microros_unlock();
  return deadline;
}

void rmw_deadline_close(xrce_deadline_t * deadline)
{
  microros_lock();
  (void)memset(deadline, 0, sizeof(*deadline));
  microros_unlock();
}

uint32_t rmw_deadline_take(xrce_deadline_t * deadline, uint32_t * change)
{
  uint32_t total;

  microros_lock();
  xrce_deadlines_step(rmw_client_instance(), port_time_ms());
  total = deadline->total;
  *change = total - deadline->taken;
  deadline->taken = total;
  microros_unlock();
  return total;
}

void rmw_deadline_notify(xrce_deadline_t * deadline, rmw_event_callback_t callback, const void * user_data)
{
  microros_lock();
  deadline->callback = callback;
  deadline->user_data = user_data;
  if (callback != NULL && deadline->total != deadline->taken) {
    const uint32_t missed = deadline->total - deadline->taken; /* also after the count wrapped */

    callback(user_data, (size_t)missed);
  }
  microros_unlock();
}
