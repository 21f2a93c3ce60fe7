/* SPDX-License-Identifier: Apache-2.0 */
/* What an action server asks the session. Internal. */
#ifndef MICROROS_RMW_ACTION_SERVER_H
#define MICROROS_RMW_ACTION_SERVER_H

#include <stdbool.h>
#include <stdint.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Return whether an open service or publisher has a session and room for a message. */
bool rmw_action_server_may_reply(const rmw_service_t * service);
bool rmw_action_server_may_publish(const rmw_publisher_t * publisher);

/* Lets a request that is too large for an open service reach it with its first bytes, so that it is answered. */
void rmw_action_server_answer_large(const rmw_service_t * service);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_ACTION_SERVER_H */
