/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_stream_best_effort_input.h"

/* Numbers from half of 2^16 on are old. */
enum { HALF = 0x8000 };

void xrce_stream_best_effort_input_reset(xrce_stream_best_effort_input_t * stream)
{
  stream->next = 0;
}

bool xrce_stream_best_effort_input_take(xrce_stream_best_effort_input_t * stream, uint16_t sequence)
{
  if ((uint16_t)(sequence - stream->next) >= HALF) {
    return false;
  }
  stream->next = (uint16_t)(sequence + 1u);
  return true;
}
