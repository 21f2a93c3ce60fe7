/* SPDX-License-Identifier: Apache-2.0 */
/* How many events there are. Internal. */
#ifndef MICROROS_RCL_EVENT_PLACES_H
#define MICROROS_RCL_EVENT_PLACES_H

#include "microros_config.h"

/* One of each type that can be observed, for each publisher and subscription: a deadline. At least one, which C requires
 * of an array. */
enum {
  RCL_EVENT_ENTITIES = MICROROS_PUBLISHERS_MAX + MICROROS_SUBSCRIPTIONS_MAX,
  RCL_WAIT_EVENTS_MAX = RCL_EVENT_ENTITIES != 0 ? RCL_EVENT_ENTITIES : 1
};

#endif /* MICROROS_RCL_EVENT_PLACES_H */
