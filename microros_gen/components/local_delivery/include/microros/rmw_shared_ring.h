/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A ring in the shared memory: its two ends, and its slots. What the writer's end has is written by the image of the writer
 * alone, likewise the reader's. Called with the lock held. Internal.
 */
#ifndef MICROROS_RMW_SHARED_RING_H
#define MICROROS_RMW_SHARED_RING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/rmw_shared.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether a message can be written. */
typedef enum rmw_shared_room_t {
  RMW_SHARED_ROOM,
  RMW_SHARED_FULL,
  RMW_SHARED_ABSENT, /* nobody reads in the other image */
  RMW_SHARED_OTHER,  /* another image was built for other rings */
  RMW_SHARED_NONE    /* the platform has no memory */
} rmw_shared_room_t;

/* Where an end is: how many messages of which run were written or read. */
typedef struct rmw_shared_place_t {
  uint32_t run;
  uint32_t count;
} rmw_shared_place_t;

/* Returns whether the memory is there; RMW_SHARED_ROOM: all images were built for the same rings. */
rmw_shared_room_t rmw_shared_look(void);

/* Returns whether a message can be written, and in *count where it is to be. */
rmw_shared_room_t rmw_shared_reserve(const rmw_shared_ring_t * ring, uint32_t * count);

/* Gives the message after `count` ones, whose body has `size` bytes, to the other image. */
void rmw_shared_commit(const rmw_shared_ring_t * ring, uint32_t count, uint32_t size);

/* Returns the slot of the message after `count` ones. */
uint32_t * rmw_shared_slot(const rmw_shared_ring_t * ring, uint32_t count);

/* Returns where the writer of this image is. One that restarts goes on: what it wrote before is still to be read. */
rmw_shared_place_t rmw_shared_writer(const rmw_shared_ring_t * ring);

/* Begins another run of a writer of this image: what it wrote before is not read any more. */
void rmw_shared_renew(const rmw_shared_ring_t * ring);

/*
 * Returns whether the reader of this image may read, and in *own and *writer the messages that wait: those between the two.
 * `follows`: it has its place; otherwise it begins where the writer is, since what was sent before is not for it. */
bool rmw_shared_read(
  const rmw_shared_ring_t * ring, bool follows, rmw_shared_place_t * own, rmw_shared_place_t * writer);

/* Says that the reader has taken the message after *count ones, and counts it. */
void rmw_shared_free(const rmw_shared_ring_t * ring, uint32_t * count);

/* Ends what this image has in a ring; it begins again with the next look at it. */
void rmw_shared_end(const rmw_shared_ring_t * ring);

/* Ends what this image has in all rings: another build may have written anything there. */
static inline void rmw_shared_clear(void)
{
  for (size_t i = 0; i < (size_t)MICROROS_SHARED_RINGS; ++i) {
    rmw_shared_end(&rmw_shared_rings[i]);
  }
}

/* Asks the platform for the memory again, if it had none. */
void rmw_shared_retry(void);

/* Returns RMW_RET_ERROR with the text for anything but room and an absent reader. */
rmw_ret_t rmw_shared_error(rmw_shared_room_t room, const char * name);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_SHARED_RING_H */
