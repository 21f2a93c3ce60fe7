/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/event.h"

#include "microros/error.h"
#include "microros/rcl_graph_event.h"
#include "microros/rmw_deadlines.h"

#include <stddef.h>

rcl_event_t rcl_get_zero_initialized_event(void)
{
  const rcl_event_t event = {NULL};

  return event;
}

bool rcl_event_is_valid(const rcl_event_t * event)
{
  return event != NULL && event->impl != NULL && event->impl->observed;
}

rcl_ret_t rcl_event_fini(rcl_event_t * event)
{
  if (event == NULL) {
    return microros_error_refuse(RCL_RET_EVENT_INVALID, "event");
  }
  if (event->impl != NULL) {
    rmw_deadline_close(event->impl);
    event->impl = NULL;
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_take_event(const rcl_event_t * event, void * event_info)
{
  rmw_offered_deadline_missed_status_t * status = event_info; /* the other one has the same members */
  uint32_t total;
  uint32_t change = 0;

  if (!rcl_event_is_valid(event)) {
    return microros_error_refuse(RCL_RET_EVENT_INVALID, "event");
  }
  if (event_info == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "event_info");
  }
  if (rcl_graph_event_take(event->impl, event_info)) {
    return RCL_RET_OK;
  }
  total = rmw_deadline_take(event->impl, &change) & (uint32_t)INT32_MAX; /* the type has no more */
  change &= (uint32_t)INT32_MAX;
  status->total_count = (int32_t)total;
  status->total_count_change = (int32_t)change;
  return RCL_RET_OK;
}

rcl_ret_t rcl_event_set_callback(
  const rcl_event_t * event, rcl_event_callback_t callback, const void * user_data)
{
  if (!rcl_event_is_valid(event)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "event");
  }
  rmw_deadline_notify(event->impl, callback, user_data);
  return RCL_RET_OK;
}
