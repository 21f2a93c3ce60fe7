/* SPDX-License-Identifier: Apache-2.0 */
/* Places without objects at the agent, since their messages stay in the image: none, unless a component replaces this
 * header. Internal. */
#ifndef MICROROS_XRCE_LOCAL_H
#define MICROROS_XRCE_LOCAL_H

#include <stdbool.h>
#include <stdint.h>

static inline bool xrce_place_is_local(uint16_t place)
{
  (void)place;
  return false;
}

/* Returns whether no place has objects at the agent, so that nothing waits for a session. */
static inline bool xrce_image_is_local(void)
{
  return false;
}

#endif /* MICROROS_XRCE_LOCAL_H */
