/* SPDX-License-Identifier: Apache-2.0 */
/* How many samples a reliable receiver requests: as many as fit, unless a component replaces this header. Internal. */
#ifndef MICROROS_XRCE_READ_GRANT_H
#define MICROROS_XRCE_READ_GRANT_H

#include <stdint.h>

/* Returns how many samples the `index`-th receiver requests whose queue has room for `room`. */
static inline uint16_t xrce_read_grant(uint16_t index, uint16_t room)
{
  (void)index;
  return room;
}

#endif /* MICROROS_XRCE_READ_GRANT_H */
