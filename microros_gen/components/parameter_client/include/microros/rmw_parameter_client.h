/* SPDX-License-Identifier: Apache-2.0 */
/* Events that are too large. Internal. */
#ifndef MICROROS_RMW_PARAMETER_CLIENT_H
#define MICROROS_RMW_PARAMETER_CLIENT_H

#include <stdint.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sets how many first bytes of a sample that is too large are passed to an open subscription; 0: none. */
void rmw_parameter_client_keep_beginning(const rmw_subscription_t * subscription, uint8_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PARAMETER_CLIENT_H */
