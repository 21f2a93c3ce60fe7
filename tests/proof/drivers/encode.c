/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An encoder and the function of its size: messages with any contents, each `size` within its limit but one at most, which
 * is any other number or has no data (sized.h). The body has max_encoded_size bytes and not one more.
 */
#include "types.h"

#include "microros/cdr.h"

uint32_t proof_members;
uint32_t proof_odd;
uint32_t proof_way;

static uint8_t body[PROOF_MAX];
static PROOF_TYPE message;

static void encode(uint32_t odd, uint32_t way)
{
  const microros_message_type_t * type = (const microros_message_type_t *)PROOF_HANDLE()->data;
  cdr_fault_t fault;

  proof_members = 0;
  proof_odd = odd;
  proof_way = way;
  PROOF_BIND(&message);
  proof_fill(&message);
  const uint32_t size = type->encoded_size(&message, &fault);
  const uint32_t written = type->encode(&message, body, &fault);
  //@ check size <= PROOF_MAX;
  //@ check written <= PROOF_MAX;
}

int main(void)
{
  encode(UINT32_MAX, PROOF_ABOVE);
  //@ loop unroll 100;
  for (uint32_t odd = 0; odd < proof_members; ++odd) {
    //@ loop unroll PROOF_WAYS;
    for (uint32_t way = 0; way < PROOF_WAYS; ++way) {
      encode(odd, way);
    }
  }
  return 0;
}
