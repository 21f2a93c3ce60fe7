/* SPDX-License-Identifier: Apache-2.0 */
/* Events of any entity; internal. */
#ifndef MICROROS_RCL_EVENT_INTERNAL_H
#define MICROROS_RCL_EVENT_INTERNAL_H

#include "microros/error.h"
#include "microros/rmw_deadlines.h"
#include "rcl/event.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Opens the event of an open entity, whose handle of rmw has this data. */
static inline rcl_ret_t rcl_event_open(rcl_event_t * event, const void * endpoint)
{
  if (event->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_event, "it is initialized already");
  }
  event->impl = rmw_deadline_open(endpoint);
  return event->impl != NULL
           ? RCL_RET_OK
           : microros_error_named(RCL_RET_ALREADY_INIT, microros_error_event, "its entity has one already");
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_EVENT_INTERNAL_H */
