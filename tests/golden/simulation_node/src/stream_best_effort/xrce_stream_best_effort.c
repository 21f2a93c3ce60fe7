/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_stream_best_effort.h"

#include "microros/xrce_wire.h"

void xrce_stream_best_effort_reset(xrce_stream_best_effort_t * stream)
{
  stream->sequence = 0;
}

uint8_t * xrce_stream_best_effort_reserve(xrce_stream_best_effort_t * stream)
{
  return &stream->message[XRCE_MESSAGE_HEADER];
}

bool xrce_stream_best_effort_commit(xrce_stream_best_effort_t * stream, xrce_session_t * session, size_t size)
{
  xrce_put_header(stream->message, XRCE_SESSION_ID, XRCE_STREAM_BEST_EFFORT, stream->sequence);
  ++stream->sequence;
  return xrce_session_send(session, stream->message, XRCE_MESSAGE_HEADER + size);
}
