/* SPDX-License-Identifier: Apache-2.0 */
/* What is at the agent from before a sleep. In place of the file of the session. Internal. */
#ifndef MICROROS_XRCE_PLACE_H
#define MICROROS_XRCE_PLACE_H

#include "microros/xrce_client.h"
#include "microros/xrce_sleep.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether the agent has a place, whose table is filled in, from before. */
static inline bool xrce_place_is_kept(const xrce_client_t * client, uint16_t place)
{
  return xrce_sleep_keeps(client, place);
}

/* The application opens a place, which is filled in. True: it is the one that was kept, and there is nothing to create. */
static inline bool xrce_place_take_up(xrce_client_t * client, uint16_t place)
{
  return xrce_sleep_take_up(client, place);
}

/* Whether that was the answer for this place the last time that one was opened. */
static inline bool xrce_place_took_up(const xrce_client_t * client, uint16_t place)
{
  return xrce_sleep_took_up(client, place);
}

/* Whether the client goes on from before instead of opening a session; then xrce_place_resume follows, once its transport
 * is prepared. `key` is that of the application, 0: as the plan says. */
static inline bool xrce_place_goes_on(xrce_client_t * client, uint32_t key)
{
  const uint32_t wanted = key != 0u || MICROROS_CLIENT_KEY_OF_DEVICE != 0u ? key : MICROROS_CLIENT_KEY;

  return xrce_sleep_is_over(client, wanted); /* 0: the key that it had */
}

static inline void xrce_place_resume(xrce_client_t * client)
{
  xrce_sleep_resume(client);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PLACE_H */
