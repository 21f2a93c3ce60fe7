/* SPDX-License-Identifier: Apache-2.0 */
/* Events, and wait sets of them. */
#include "rcl/event.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_graph_event.h"
#include "microros/rcl_wait_events.h"
#include "microros/rmw_deadlines.h"
#include "microros/xrce_deadlines.h"

#include <stddef.h>
#include <string.h>

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

void rcl_wait_events_clear(const rcl_wait_set_t * wait_set)
{
  (void)memset(wait_set->impl->events, 0, sizeof(wait_set->impl->events));
  wait_set->impl->event_count = 0;
}

void rcl_wait_events_resize(rcl_wait_set_t * wait_set, size_t size)
{
  wait_set->events = size != 0u ? wait_set->impl->events : NULL;
  wait_set->size_of_events = size;
}

static bool wait_event_is_ready(const rcl_event_t * event)
{
  bool is_ready;

  microros_lock();
  is_ready = rcl_event_is_valid(event) && event->impl->total != event->impl->taken;
  microros_unlock();
  return is_ready;
}

bool rcl_wait_events_look(const rcl_wait_set_t * wait_set, bool settles)
{
  bool any = false;

  for (size_t i = 0; i < wait_set->size_of_events; ++i) {
    if (wait_event_is_ready(wait_set->events[i])) {
      any = true;
    } else if (settles) {
      wait_set->events[i] = NULL;
    } else {
      /* it stays */
    }
  }
  return any;
}

rcl_ret_t rcl_wait_set_add_event(rcl_wait_set_t * wait_set, const rcl_event_t * event, size_t * index)
{
  size_t place;

  if (wait_set == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "wait_set");
  }
  if (wait_set->impl == NULL) {
    return microros_error_refuse(RCL_RET_WAIT_SET_INVALID, "wait_set");
  }
  if (event == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "event");
  }
  place = wait_set->impl->event_count;
  if (place == wait_set->size_of_events) {
    return microros_error_named(RCL_RET_WAIT_SET_FULL, microros_error_event, "the wait set is full");
  }
  wait_set->events[place] = event;
  ++wait_set->impl->event_count;
  if (index != NULL) {
    *index = place;
  }
  return RCL_RET_OK;
}
