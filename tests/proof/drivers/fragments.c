/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One piece of a sample: of each size that the slot of its reader has room for, from each number of bytes that are here
 * already, with pieces of any size that a message has room for. What is copied lies within the sample, and what is handed
 * on is all of it.
 */
#include "proof.h"

#include "microros/xrce_client.h"

enum { SLOT = 8 };

static xrce_client_t client;
static uint8_t slot[SLOT];
static uint8_t submessage[XRCE_SUBMESSAGE_HEADER + MICROROS_INPUT_SIZE];

bool xrce_read_begin(xrce_client_t * taker, const xrce_arrival_t * arrival)
{
  (void)taker;
  return arrival->size <= SLOT && proof_bool();
}

uint8_t * xrce_read_place(xrce_client_t * taker, const xrce_arrival_t * arrival)
{
  (void)taker;
  //@ check arrival->size <= SLOT;
  (void)arrival;
  return proof_bool() ? slot : NULL;
}

void xrce_read_finish(xrce_client_t * taker, const xrce_arrival_t * arrival, uint32_t now)
{
  (void)taker;
  (void)now;
  //@ check arrival->size <= SLOT;
  (void)arrival;
}

void proof_copy(void * to, const void * from, size_t size)
{
  const size_t place = (size_t)((uint8_t *)to - slot);

  //@ check place + size <= SLOT;
  proof_any(to, size);
  (void)from;
}

static void take(uint16_t whole, uint16_t here, size_t least, size_t most)
{
  const size_t size = Frama_C_size_t_interval(least, most);

  proof_any(submessage, sizeof(submessage));
  proof_any(&client.fragments.sample, sizeof(client.fragments.sample));
  client.fragments.sample.size = whole;
  client.fragments.arrived = here;
  client.fragments.begun = proof_bool();
  client.fragments.next = proof_u16();
  client.fragments.skipping = proof_bool();
  client.reliable_input.next = proof_u16();
  client.session.statistics.malformed = proof_u32();
  xrce_fragments_on_fragment(&client, submessage, size, proof_u32());
  //@ check !client.fragments.begun || client.fragments.skipping || client.fragments.sample.size <= SLOT;
  //@ check !client.fragments.begun || client.fragments.skipping || client.fragments.arrived <= SLOT;
}

int main(void)
{
  //@ loop unroll SLOT + 1;
  for (uint32_t whole = 1; whole <= SLOT; ++whole) {
    //@ loop unroll SLOT + 1;
    for (uint32_t here = 0; here <= whole; ++here) {
      take((uint16_t)whole, (uint16_t)here, 0, 7); /* less than what a sample begins with */
      take((uint16_t)whole, (uint16_t)here, 8, MICROROS_INPUT_SIZE);
    }
  }
  return 0;
}
