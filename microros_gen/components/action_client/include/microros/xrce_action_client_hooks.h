/* SPDX-License-Identifier: Apache-2.0 */
/* Hook called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_ACTION_CLIENT_HOOKS_H
#define MICROROS_XRCE_ACTION_CLIENT_HOOKS_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A WRITE_DATA submessage was removed from the stream. The request in it is not outstanding any more. */
void xrce_action_client_drop(xrce_client_t * client, const uint8_t * dropped);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ACTION_CLIENT_HOOKS_H */
