/* SPDX-License-Identifier: Apache-2.0 */
/* Places without objects at an agent, from the plan. Internal. */
#ifndef MICROROS_XRCE_LOCAL_H
#define MICROROS_XRCE_LOCAL_H

#include <stdbool.h>
#include <stdint.h>

#include "microros_config.h"

/* One for each place: true for an endpoint with `only`, and for each node of an image that has no other ones. */
extern const bool xrce_local_places[];

static inline bool xrce_place_is_local(uint16_t place)
{
  return xrce_local_places[place];
}

/* Returns whether no place has objects at the agent, so that nothing waits for a session. */
static inline bool xrce_image_is_local(void)
{
  return MICROROS_LOCAL_IMAGE != 0u;
}

#endif /* MICROROS_XRCE_LOCAL_H */
