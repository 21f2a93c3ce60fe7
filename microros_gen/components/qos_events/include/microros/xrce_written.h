/* SPDX-License-Identifier: Apache-2.0 */
/* Called for each message of a publisher that was handed to its stream. Replaces the header of component `write`.
 * Internal. */
#ifndef MICROROS_XRCE_WRITTEN_H
#define MICROROS_XRCE_WRITTEN_H

#include "microros/xrce_deadlines.h"

static inline void xrce_written(const xrce_endpoint_t * writer)
{
  xrce_deadline_meet(writer->client, writer->index);
}

#endif /* MICROROS_XRCE_WRITTEN_H */
