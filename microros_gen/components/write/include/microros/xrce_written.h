/* SPDX-License-Identifier: Apache-2.0 */
/* Called for each message of a publisher that was handed to its stream: nothing, unless a component replaces this
 * header. Internal. */
#ifndef MICROROS_XRCE_WRITTEN_H
#define MICROROS_XRCE_WRITTEN_H

#include "microros/xrce_objects.h"

static inline void xrce_written(const xrce_endpoint_t * writer)
{
  (void)writer;
}

#endif /* MICROROS_XRCE_WRITTEN_H */
