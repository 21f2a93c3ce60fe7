/* SPDX-License-Identifier: Apache-2.0 */
/* State at the agent from before a sleep. Replaces the header of component `session`. Internal. */
#ifndef MICROROS_XRCE_PLACE_H
#define MICROROS_XRCE_PLACE_H

#include "microros/xrce_client.h"
#include "microros/xrce_sleep.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether the agent still has a place, whose table is filled in. */
static inline bool xrce_place_is_kept(const xrce_client_t * client, uint16_t place)
{
  return xrce_sleep_keeps(client, place);
}

/*
 * Called when the application opens a place, which is filled in. True: the preserved one, nothing has to
 * be created. */
static inline bool xrce_place_restore(xrce_client_t * client, uint16_t place)
{
  return xrce_sleep_restore(client, place);
}

/* Returns the result of xrce_place_restore for this place when it was last opened. */
static inline bool xrce_place_was_restored(const xrce_client_t * client, uint16_t place)
{
  return xrce_sleep_was_restored(client, place);
}

/* Returns whether the client resumes a session instead of opening one; xrce_place_resume follows once its
 * transport is prepared. `key` is the application's, 0: that of the plan. */
static inline bool xrce_place_can_resume(xrce_client_t * client, uint32_t key)
{
  const uint32_t wanted = key != 0u || MICROROS_CLIENT_KEY_OF_DEVICE != 0u ? key : MICROROS_CLIENT_KEY;

  return xrce_sleep_is_over(client, wanted); /* 0: the key from before the sleep */
}

static inline void xrce_place_resume(xrce_client_t * client)
{
  xrce_sleep_resume(client);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PLACE_H */
