/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One byte on its way out: from every number of bytes that a chunk may hold, with every byte, to a chunk that holds only
 * bytes written to it. A message is such bytes one after another.
 */
#include "proof.h"

#include "microros/xrce_framing.h"

#include "src/framing/xrce_framing_send.c"

/*@ ensures writer->held <= CHUNK;
    ensures \initialized(&writer->chunk[0 .. writer->held - 1]); */
static void put(frame_writer_t * writer, uint8_t byte)
{
  writer_put(writer, &byte, 1);
}

size_t xrce_line_room(struct xrce_transport_t * line)
{
  (void)line;
  return proof_size(SIZE_MAX);
}

bool xrce_line_write(struct xrce_transport_t * line, const uint8_t * data, size_t size)
{
  //@ check \initialized(data + (0 .. size - 1));
  (void)line;
  return proof_bool();
}

size_t xrce_line_read(struct xrce_transport_t * line, uint8_t * chunk, size_t capacity)
{
  (void)line;
  (void)chunk;
  (void)capacity;
  return 0;
}

int main(void)
{
  for (uint8_t held = 0; held <= CHUNK; ++held) {
    frame_writer_t writer;

    proof_any(writer.chunk, held);
    writer.line = NULL;
    writer.fine = proof_bool();
    writer.held = held;
    put(&writer, proof_u8());
  }
  return 0;
}
