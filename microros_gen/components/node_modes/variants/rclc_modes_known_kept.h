/* SPDX-License-Identifier: Apache-2.0 */
/* Which modes each node has, for requests of this device itself. Internal. */
#ifndef MICROROS_RCLC_MODES_KNOWN_H
#define MICROROS_RCLC_MODES_KNOWN_H

#include "rclc_modes/rclc_modes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called when modes are initialized and before they are finalized. */
void rclc_modes_register(rclc_modes_t * modes);
void rclc_modes_remove(const rclc_modes_t * modes);

/* Returns whether the executor of these modes has to begin a round. */
bool rclc_modes_is_requested(const rclc_modes_t * modes);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_MODES_KNOWN_H */
