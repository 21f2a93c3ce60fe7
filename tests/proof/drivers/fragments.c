/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One piece of a sample: from each number of bytes that are here already, with pieces of any size that a message has room
 * for, to a number that the buffer has room for. What is handed on lies within the buffer.
 */
#include "proof.h"

#include "microros/xrce_client.h"

static xrce_client_t client;
static uint8_t piece[MICROROS_INPUT_SIZE];

void xrce_read_refuse(xrce_client_t * taker, uint16_t request, uint16_t object, uint16_t size)
{
  (void)taker;
  (void)request;
  (void)object;
  (void)size;
}

void xrce_read_on_data(
  xrce_client_t * taker, const uint8_t * payload, size_t size, uint8_t flags, uint32_t now)
{
  (void)taker;
  (void)flags;
  (void)now;
  //@ check 1 <= size ==> \valid_read(payload) && \valid_read(payload + size - 1);
  //@ check size + 4 <= MICROROS_REASSEMBLY_SIZE;
  (void)payload;
  (void)size;
}

void proof_copy(void * to, const void * from, size_t size)
{
  const size_t place = (size_t)((uint8_t *)to - client.fragments.submessage);

  //@ check place + size <= MICROROS_REASSEMBLY_SIZE;
  proof_any(to, size);
  (void)from;
}

static void take(uint16_t here, size_t least, size_t most)
{
  const size_t size = Frama_C_size_t_interval(least, most);

  proof_any(client.fragments.submessage, sizeof(client.fragments.submessage));
  proof_any(piece, sizeof(piece));
  client.fragments.size = here;
  client.fragments.next = proof_u16();
  client.fragments.skipping = proof_bool();
  client.reliable_input.next = proof_u16();
  client.session.statistics.malformed = proof_u32();
  xrce_fragments_on_piece(&client, piece, size, proof_u8(), proof_u32());
  //@ check client.fragments.size <= MICROROS_REASSEMBLY_SIZE;
}

int main(void)
{
  //@ loop unroll MICROROS_REASSEMBLY_SIZE + 1;
  for (uint32_t here = 0; here <= MICROROS_REASSEMBLY_SIZE; ++here) {
    take((uint16_t)here, 0, 7); /* less than what a sample begins with */
    take((uint16_t)here, 8, sizeof(piece));
  }
  return 0;
}
