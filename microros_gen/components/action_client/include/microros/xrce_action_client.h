/* SPDX-License-Identifier: Apache-2.0 */
/* Requests whose replies nothing waits for any more. Internal. */
#ifndef MICROROS_XRCE_ACTION_CLIENT_H
#define MICROROS_XRCE_ACTION_CLIENT_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Frees the place of an outstanding request, whose reply is discarded from now on; nothing if it is not outstanding. It
 * is not reported as lost with a session either. */
void xrce_action_client_abandon(const xrce_endpoint_t * endpoint, int64_t sequence_number);

/* Returns whether a reply to the request may come. */
bool xrce_action_client_expects(const xrce_endpoint_t * endpoint, int64_t sequence_number);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ACTION_CLIENT_H */
