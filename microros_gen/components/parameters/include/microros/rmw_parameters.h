/* SPDX-License-Identifier: Apache-2.0 */
/* Whether an event would be sent, and requests that are too large. Internal. */
#ifndef MICROROS_RMW_PARAMETERS_H
#define MICROROS_RMW_PARAMETERS_H

#include <stdbool.h>
#include <stdint.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether an open publisher has a session and room in its stream; receives nothing. Unlike a publish that
 * fails, it does not count a dropped sample. */
bool rmw_parameters_have_room(const rmw_publisher_t * publisher);

/* The identity of a request, and the length of its first list. */
enum { RMW_PARAMETERS_BEGINNING = 28 };

/* Sets how many bytes of a request that is too large for an open service reach it: RMW_PARAMETERS_BEGINNING, or 0. */
void rmw_parameters_answer_large(const rmw_service_t * service, uint8_t beginning);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PARAMETERS_H */
