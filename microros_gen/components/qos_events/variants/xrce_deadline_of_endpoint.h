/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_XRCE_DEADLINE_OF_H
#define MICROROS_XRCE_DEADLINE_OF_H

#include "microros/xrce_objects.h"

/* Returns the deadline in milliseconds; 0: none. */
static inline uint32_t xrce_deadline_of(const xrce_endpoint_t * endpoint)
{
  return endpoint->deadline_ms;
}

#endif /* MICROROS_XRCE_DEADLINE_OF_H */
