/* SPDX-License-Identifier: Apache-2.0 */
/* What every driver uses: values that the analyzer takes for any of their type. */
#ifndef PROOF_H
#define PROOF_H

#include "__fc_builtin.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

static inline bool proof_bool(void)
{
  return Frama_C_interval(0, 1) == 1;
}

static inline uint8_t proof_u8(void)
{
  return (uint8_t)Frama_C_interval(0, UINT8_MAX);
}

static inline uint16_t proof_u16(void)
{
  return (uint16_t)Frama_C_interval(0, UINT16_MAX);
}

static inline uint32_t proof_u32(void)
{
  return Frama_C_unsigned_int_interval(0, UINT32_MAX);
}

static inline size_t proof_size(size_t most)
{
  return Frama_C_size_t_interval(0, most);
}

/* Gives `bytes` bytes any contents. */
static inline void proof_any(void * to, size_t bytes)
{
  if (bytes != 0u) {
    Frama_C_make_unknown((char *)to, bytes);
  }
}

#endif /* PROOF_H */
