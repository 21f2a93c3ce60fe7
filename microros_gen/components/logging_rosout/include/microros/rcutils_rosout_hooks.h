/* SPDX-License-Identifier: Apache-2.0 */
/* Called by xrce_routes.c. Internal. */
#ifndef MICROROS_RCUTILS_ROSOUT_HOOKS_H
#define MICROROS_RCUTILS_ROSOUT_HOOKS_H

#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called in each pump: sends lines that wait, and a line that says how many were dropped. */
void microros_rosout_step(const xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_ROSOUT_HOOKS_H */
