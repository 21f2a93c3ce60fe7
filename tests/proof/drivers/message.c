/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The submessages of a message: every message of FIRST to LAST bytes, which ends where its array ends. What is handed
 * on lies within the message.
 */
#include "proof.h"

#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"

uint8_t proof_message[LAST];
uint32_t proof_place;
uint32_t proof_length;

static xrce_client_t client;

void xrce_route_submessage(xrce_client_t * taker, const uint8_t * submessage, size_t size, uint32_t now)
{
  const size_t last = XRCE_SUBMESSAGE_HEADER + size - 1u;

  (void)now;
  //@ check taker == &client;
  //@ check size <= LAST - 8;
  //@ check \valid_read(submessage) && \valid_read(submessage + last);
  (void)submessage[last];
}

int main(void)
{
  //@ loop unroll LAST + 1;
  for (size_t size = FIRST; size <= (size_t)LAST; ++size) {
    proof_any(proof_message, sizeof(proof_message));
    (void)xrce_session_take_submessages(&client, &proof_message[LAST - size], size, proof_u32());
    //@ merge proof_place;
    //@ merge proof_length;
    ;
  }
  return 0;
}
