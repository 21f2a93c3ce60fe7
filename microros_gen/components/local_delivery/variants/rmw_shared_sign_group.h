/* SPDX-License-Identifier: Apache-2.0 */
/* How the images of a chip with more than two say how they were built. For rmw_shared_ring.c. Internal. */
#ifndef MICROROS_RMW_SHARED_SIGN_H
#define MICROROS_RMW_SHARED_SIGN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/port_shared.h"
#include "microros/rmw_shared_ring.h"

/*
 * The memory begins with two words of each image, which say how it was built. Only that image writes them, the mark last. An
 * image that finds another build is SHARED_WAITING and writes nothing else: the others may still exchange messages where it has
 * its rings. Its own rings are cleared before it is SHARED_SIGNED. */
enum { SHARED_MARK, SHARED_KEY, SHARED_WORDS, SHARED_SIGNED = 0x6d726f73, SHARED_WAITING = 0x6d726f77 };

/* Returns whether an image was built for other rings than this one. */
static inline bool rmw_shared_differs(const volatile uint32_t * region)
{
  bool differs = false;

  for (size_t i = 0; i < (size_t)MICROROS_SHARED_IMAGES; ++i) {
    const volatile uint32_t * image = &region[i * (size_t)SHARED_WORDS];
    const uint32_t mark = image[SHARED_MARK];
    const uint32_t key = image[SHARED_KEY];

    if (
      i * (size_t)SHARED_WORDS != MICROROS_SHARED_OWN &&
      (mark == (uint32_t)SHARED_SIGNED || mark == (uint32_t)SHARED_WAITING) && key != MICROROS_SHARED_KEY) {
      differs = true;
    }
  }
  return differs;
}

/* Says how this image was built, and returns whether all others were built for the same rings or have said nothing yet. */
static inline bool rmw_shared_agrees(volatile uint32_t * region)
{
  volatile uint32_t * own = &region[MICROROS_SHARED_OWN];
  const bool differs = rmw_shared_differs(region);
  const uint32_t mark = differs ? (uint32_t)SHARED_WAITING : (uint32_t)SHARED_SIGNED;

  if (own[SHARED_MARK] != mark || own[SHARED_KEY] != MICROROS_SHARED_KEY) {
    own[SHARED_MARK] = 0;
    port_shared_barrier();
    if (!differs) {
      rmw_shared_clear();
    }
    own[SHARED_KEY] = MICROROS_SHARED_KEY;
    port_shared_barrier();
    own[SHARED_MARK] = mark;
  }
  return !differs;
}

/* Returns whether this image may end its rings: not where others may have theirs. */
static inline bool rmw_shared_may_end(const volatile uint32_t * region)
{
  return region[MICROROS_SHARED_OWN + (uint32_t)SHARED_MARK] != (uint32_t)SHARED_WAITING;
}

/* Bits of a run that name its image: a server finds by them whose request it answers. */
enum { SHARED_RUN_IMAGES = 15 };

/* Returns the number of the run after `run`. */
static inline uint32_t rmw_shared_next_run(uint32_t run)
{
  return (run | (uint32_t)SHARED_RUN_IMAGES) + 1u + MICROROS_SHARED_OWN / (uint32_t)SHARED_WORDS;
}

#endif /* MICROROS_RMW_SHARED_SIGN_H */
