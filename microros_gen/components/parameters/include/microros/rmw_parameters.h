/* SPDX-License-Identifier: Apache-2.0 */
/* Whether an event would be sent, and requests that are too large. Internal. */
#ifndef MICROROS_RMW_PARAMETERS_H
#define MICROROS_RMW_PARAMETERS_H

#include <stdbool.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether the stream of an open publisher has room, and a session; without receiving. Other than a publish that fails, this
 * counts nothing as dropped. */
bool rmw_parameters_have_room(const rmw_publisher_t * publisher);

/* Sets whether a request that is too large for an open service reaches it as the first 4 bytes of its body. */
void rmw_parameters_answer_large(const rmw_service_t * service, bool answers);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PARAMETERS_H */
