/* SPDX-License-Identifier: Apache-2.0 */
/* Whether an endpoint may write now: always, unless a component replaces this header. Internal. */
#ifndef MICROROS_XRCE_GATE_H
#define MICROROS_XRCE_GATE_H

#include <stdbool.h>

#include "microros/xrce_objects.h"

/* Returns false for what is to be dropped and counted. */
static inline bool xrce_gate_is_open(const xrce_endpoint_t * writer)
{
  (void)writer;
  return true;
}

#endif /* MICROROS_XRCE_GATE_H */
