/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_SERVICES_HOOKS_H
#define MICROROS_XRCE_SERVICES_HOOKS_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether the free slots of the reliable stream are reserved for replies. */
static inline bool xrce_services_keep_back(const xrce_client_t * client, bool reliable)
{
  return reliable && (uint32_t)client->reliable.count + client->replies_due >= MICROROS_RELIABLE_SLOTS;
}

/* Returns whether all slots of the reliable stream are reserved for replies: dropping a message makes no room. */
static inline bool xrce_services_keep_all(const xrce_client_t * client)
{
  return client->replies_due >= MICROROS_RELIABLE_SLOTS;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERVICES_HOOKS_H */
