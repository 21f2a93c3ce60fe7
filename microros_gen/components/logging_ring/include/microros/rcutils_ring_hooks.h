/* SPDX-License-Identifier: Apache-2.0 */
/* Called by xrce_routes.c. Internal. */
#ifndef MICROROS_RCUTILS_RING_HOOKS_H
#define MICROROS_RCUTILS_RING_HOOKS_H

#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called in each pump: hands lines from before the reset to /rosout, once it is open and has room. */
void microros_ring_step(const xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_RING_HOOKS_H */
