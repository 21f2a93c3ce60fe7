/* SPDX-License-Identifier: Apache-2.0 */
/* What the session calls of this component, in the functions that component.yaml names. Internal. */
#ifndef MICROROS_XRCE_SERVICES_HOOKS_H
#define MICROROS_XRCE_SERVICES_HOOKS_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether the free slots of the reliable stream are kept back for replies. */
static inline bool xrce_services_keep_back(const xrce_client_t * client, bool reliable)
{
  return reliable && (uint32_t)client->reliable.count + client->owed >= MICROROS_RELIABLE_SLOTS;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERVICES_HOOKS_H */
