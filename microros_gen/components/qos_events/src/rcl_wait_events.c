/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_wait_events.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/xrce_deadlines.h"
#include "rcl/event.h"

#include <string.h>

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
