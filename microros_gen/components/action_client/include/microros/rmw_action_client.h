/* SPDX-License-Identifier: Apache-2.0 */
/* What an action client asks the session. Internal. */
#ifndef MICROROS_RMW_ACTION_CLIENT_H
#define MICROROS_RMW_ACTION_CLIENT_H

#include <stdbool.h>
#include <stdint.h>

#include "rmw/ret_types.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- for open clients and subscriptions --- */

/* Returns whether there is a session and room for a request. */
bool rmw_action_client_may_send(const rmw_client_t * client);

/* Returns a number that is another one when requests were dropped. */
uint32_t rmw_action_client_drops(const rmw_client_t * client);

/* Returns whether a reply to the request may come. */
bool rmw_action_client_expects(const rmw_client_t * client, int64_t sequence_number);

/* Discards the reply to an outstanding request. */
void rmw_action_client_abandon(const rmw_client_t * client, int64_t sequence_number);

/* Copies the first `size` bytes of the oldest sample; false without one, or if it is shorter. */
bool rmw_action_client_peek(const rmw_subscription_t * subscription, uint8_t * beginning, uint16_t size);

/* Removes the oldest sample; instead returns RMW_RET_ERROR, with a text, once for a sample or a reader that was refused. */
rmw_ret_t rmw_action_client_drop(const rmw_subscription_t * subscription);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_ACTION_CLIENT_H */
