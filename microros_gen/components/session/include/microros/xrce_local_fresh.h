/* SPDX-License-Identifier: Apache-2.0 */
/* Whether a message of the image came since the last pump: never, unless a component replaces this header. Internal. */
#ifndef MICROROS_XRCE_LOCAL_FRESH_H
#define MICROROS_XRCE_LOCAL_FRESH_H

#include <stdbool.h>

/* Returns whether an executor may look for messages without a pump. */
static inline bool xrce_local_take_fresh(void)
{
  return false;
}

#endif /* MICROROS_XRCE_LOCAL_FRESH_H */
