/* SPDX-License-Identifier: Apache-2.0 */
/* No endpoint of the application has a deadline. */
#ifndef MICROROS_XRCE_DEADLINE_OF_H
#define MICROROS_XRCE_DEADLINE_OF_H

#include "microros/xrce_objects.h"

/* Returns the deadline in milliseconds; 0: none. */
static inline uint32_t xrce_deadline_of(const xrce_endpoint_t * endpoint)
{
  (void)endpoint;
  return 0;
}

#endif /* MICROROS_XRCE_DEADLINE_OF_H */
