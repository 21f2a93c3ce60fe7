/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sizes of strings and sequences: all within their limits but that of the member `proof_odd`, which is above it, or whose
 * data is NULL. An encoder goes through the members in order and ends at the first that is refused.
 */
#ifndef SIZED_H
#define SIZED_H

#include "proof.h"

enum { PROOF_ABOVE, PROOF_NONE, PROOF_NULL, PROOF_WAYS };

extern uint32_t proof_members; /* so far */
extern uint32_t proof_odd;
extern uint32_t proof_way;

static inline size_t proof_sized(size_t limit, bool * null)
{
  const bool odd = proof_members == proof_odd;

  ++proof_members;
  *null = odd && proof_way != PROOF_ABOVE;
  if (!odd) {
    return proof_size(limit);
  }
  if (proof_way == PROOF_NONE) {
    return 0;
  }
  return Frama_C_size_t_interval(proof_way == PROOF_ABOVE ? limit + 1u : 1u, SIZE_MAX);
}

#define PROOF_SIZED(member, limit) \
  do { \
    bool null; \
    (member).size = proof_sized((limit), &null); \
    if (null) { \
      (member).data = NULL; \
    } \
  } while (0)

#endif /* SIZED_H */
