/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_stream_best_effort_input.h"

/* Numbers up to this far before the newest are old; others follow a jump. Networks do not delay a datagram
 * past so many others, and one forged or stale datagram must not block half of all numbers. */
enum { OLD = 64 };

void xrce_stream_best_effort_input_reset(xrce_stream_best_effort_input_t * stream)
{
  stream->next = 0;
}

bool xrce_stream_best_effort_input_take(xrce_stream_best_effort_input_t * stream, uint16_t sequence)
{
  if ((uint16_t)(stream->next - 1u - sequence) < OLD) {
    return false;
  }
  stream->next = (uint16_t)(sequence + 1u);
  return true;
}
