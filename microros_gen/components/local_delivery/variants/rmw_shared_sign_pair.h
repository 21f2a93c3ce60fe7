/* SPDX-License-Identifier: Apache-2.0 */
/* How the two images of a chip say how they were built. For rmw_shared_ring.c. Internal. */
#ifndef MICROROS_RMW_SHARED_SIGN_H
#define MICROROS_RMW_SHARED_SIGN_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/port_shared.h"
#include "microros/rmw_shared_ring.h"

/* The memory begins with two words of each image, which say how it was built. Only that image writes them, the mark last. */
enum { SHARED_MARK, SHARED_KEY, SHARED_SIGNED = 0x6d726f73 };

/* Says how this image was built. */
static inline void rmw_shared_sign(volatile uint32_t * region)
{
  volatile uint32_t * own = &region[MICROROS_SHARED_OWN];

  if (own[SHARED_MARK] != (uint32_t)SHARED_SIGNED || own[SHARED_KEY] != MICROROS_SHARED_KEY) {
    own[SHARED_MARK] = 0;
    port_shared_barrier();
    rmw_shared_clear();
    own[SHARED_KEY] = MICROROS_SHARED_KEY;
    port_shared_barrier();
    own[SHARED_MARK] = (uint32_t)SHARED_SIGNED;
  }
}

/* Says how this image was built, and returns whether the other one was built for the same rings or has said nothing yet. */
static inline bool rmw_shared_agrees(volatile uint32_t * region)
{
  const volatile uint32_t * other = &region[MICROROS_SHARED_OTHER];

  rmw_shared_sign(region);
  if (other[SHARED_MARK] == (uint32_t)SHARED_SIGNED && other[SHARED_KEY] != MICROROS_SHARED_KEY) {
    rmw_shared_clear();
    return false;
  }
  return true;
}

/* Returns whether this image may end its rings. */
static inline bool rmw_shared_may_end(const volatile uint32_t * region)
{
  (void)region;
  return true;
}

/* Returns the number of the run after `run`. */
static inline uint32_t rmw_shared_next_run(uint32_t run)
{
  return run + 1u;
}

#endif /* MICROROS_RMW_SHARED_SIGN_H */
