/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Put before the session (-include): one state for each place of a submessage in a message, and for each length that it
 * says, up to the largest message of the proof. Nothing is assumed of either.
 */
#ifndef SPLIT_SUBMESSAGE_H
#define SPLIT_SUBMESSAGE_H

#include "microros/xrce_wire.h"

extern uint8_t proof_message[];
extern uint32_t proof_place;
extern uint32_t proof_length;

static inline uint16_t proof_get_length(const uint8_t * at)
{
  proof_place = (uint32_t)(at - proof_message);
  //@ split proof_place;
  //@ merge proof_length;
  proof_length = xrce_get_le16(at);
  if (proof_length > (uint32_t)LAST) {
    return (uint16_t)proof_length;
  }
  //@ split proof_length;
  return (uint16_t)proof_length;
}

#define xrce_get_le16 proof_get_length

#endif /* SPLIT_SUBMESSAGE_H */
