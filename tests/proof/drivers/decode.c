/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A decoder, with the primitives that it calls: every body of FIRST to LAST bytes, in both byte orders. The body ends
 * where its array ends, so that a byte read after it is an alarm.
 */
#include "proof.h"
#include "types.h"

#include "microros/cdr_decode.h"

uint32_t proof_position;
uint32_t proof_length;

static uint8_t buffer[LAST];
static PROOF_TYPE message;

int main(void)
{
  const microros_message_type_t * type = (const microros_message_type_t *)PROOF_HANDLE()->data;

  proof_any(buffer, sizeof(buffer));
  //@ loop unroll LAST + 1;
  for (uint32_t size = FIRST; size <= (uint32_t)LAST; ++size) {
    cdr_fault_t fault;
    PROOF_BIND(&message);
    (void)cdr_decode(type, &buffer[LAST - size], size, proof_bool(), &message, &fault);
    //@ merge proof_position;
    //@ merge proof_length;
    ;
  }
  return 0;
}
