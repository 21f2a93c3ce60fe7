/* SPDX-License-Identifier: Apache-2.0 */
/* Whether a message of the image came since the last pump. Internal. */
#ifndef MICROROS_XRCE_LOCAL_FRESH_H
#define MICROROS_XRCE_LOCAL_FRESH_H

#include <stdbool.h>

/* Set with each message for a subscription of the image. Written with the lock held. */
extern bool xrce_local_fresh;

/* Returns whether the executor may look for messages without a pump, once for each message; with the lock held. */
static inline bool xrce_local_take_fresh(void)
{
  const bool fresh = xrce_local_fresh;

  xrce_local_fresh = false;
  return fresh;
}

#endif /* MICROROS_XRCE_LOCAL_FRESH_H */
