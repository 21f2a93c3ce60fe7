/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What is at the agent from before the application opened it: nothing. A component that keeps a session brings another file
 * of this name. Internal.
 */
#ifndef MICROROS_XRCE_PLACE_H
#define MICROROS_XRCE_PLACE_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether the agent has a place, whose table is filled in, from before. */
static inline bool xrce_place_is_kept(const xrce_client_t * client, uint16_t place)
{
  (void)client;
  (void)place;
  return false;
}

/* The application opens a place, which is filled in. True: it is the one that was kept, and there is nothing to create. */
static inline bool xrce_place_take_up(xrce_client_t * client, uint16_t place)
{
  (void)client;
  (void)place;
  return false;
}

/* Whether that was the answer for this place the last time that one was opened. */
static inline bool xrce_place_took_up(const xrce_client_t * client, uint16_t place)
{
  (void)client;
  (void)place;
  return false;
}

/* Whether the client goes on from before instead of opening a session; then xrce_place_resume follows, once its transport
 * is prepared. `key` is that of the application, 0: as the plan says. */
static inline bool xrce_place_goes_on(xrce_client_t * client, uint32_t key)
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
