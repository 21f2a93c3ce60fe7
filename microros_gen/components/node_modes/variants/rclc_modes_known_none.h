/* SPDX-License-Identifier: Apache-2.0 */
/* Which modes each node has: nobody asks, so nothing is kept. Internal. */
#ifndef MICROROS_RCLC_MODES_KNOWN_H
#define MICROROS_RCLC_MODES_KNOWN_H

#include "rclc_modes/rclc_modes.h"

/* Called when modes are initialized and before they are finalized. */
static inline void rclc_modes_register(rclc_modes_t * modes)
{
  (void)modes;
}

static inline void rclc_modes_remove(const rclc_modes_t * modes)
{
  (void)modes;
}

static inline bool rclc_modes_is_requested(const rclc_modes_t * modes)
{
  (void)modes;
  return false;
}

#endif /* MICROROS_RCLC_MODES_KNOWN_H */
