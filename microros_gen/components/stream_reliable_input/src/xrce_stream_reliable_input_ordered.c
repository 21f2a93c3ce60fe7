/* SPDX-License-Identifier: Apache-2.0 */
/* The only slot is the input buffer: messages are accepted in sequence only. */
#include "microros/xrce_stream_reliable_input.h"

void xrce_stream_reliable_input_keep(
  xrce_stream_reliable_input_t * stream, uint16_t sequence, const uint8_t * message, size_t size)
{
  (void)stream;
  (void)sequence;
  (void)message;
  (void)size;
}

const uint8_t * xrce_stream_reliable_input_kept(
  xrce_stream_reliable_input_t * stream, uint16_t sequence, size_t * size)
{
  (void)stream;
  (void)sequence;
  (void)size;
  return NULL;
}

uint16_t xrce_stream_reliable_input_map(const xrce_stream_reliable_input_t * stream)
{
  (void)stream;
  return 0;
}
