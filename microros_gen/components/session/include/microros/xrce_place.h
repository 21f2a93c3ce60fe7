/* SPDX-License-Identifier: Apache-2.0 */
/*
 * State at the agent from before the place was opened: none. A component that preserves a session replaces
 * this header. Internal.
 */
#ifndef MICROROS_XRCE_PLACE_H
#define MICROROS_XRCE_PLACE_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether the agent still has a place, whose table is filled in. */
static inline bool xrce_place_is_kept(const xrce_client_t * client, uint16_t place)
{
  (void)client;
  (void)place;
  return false;
}

/*
 * Called when the application opens a place, which is filled in. True: the preserved one, nothing has to
 * be created. */
static inline bool xrce_place_restore(xrce_client_t * client, uint16_t place)
{
  (void)client;
  (void)place;
  return false;
}

/* Returns the result of xrce_place_restore for this place when it was last opened. */
static inline bool xrce_place_was_restored(const xrce_client_t * client, uint16_t place)
{
  (void)client;
  (void)place;
  return false;
}

/* Returns whether the client resumes a session instead of opening one; xrce_place_resume follows once its
 * transport is prepared. `key` is the application's, 0: that of the plan. */
static inline bool xrce_place_can_resume(xrce_client_t * client, uint32_t key)
{
  (void)client;
  (void)key;
  return false;
}

static inline void xrce_place_resume(xrce_client_t * client)
{
  (void)client;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PLACE_H */
