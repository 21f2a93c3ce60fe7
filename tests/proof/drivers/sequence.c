/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The primitives of sequences: from each position (of eight, as alignments go), with each number of bytes after it up to
 * LAST, each length that these bytes may say, in both byte orders, and each capacity up to CAPACITY.
 */
#include "proof.h"

#include "microros/cdr_decode.h"

enum { POSITIONS = 8, LENGTH = 4 };

typedef struct any_sequence_t {
  void * data;
  size_t size;
  size_t capacity;
} any_sequence_t;

static uint8_t buffer[POSITIONS + LAST];
static uint8_t room[CAPACITY * 8];

static void read(uint32_t position, uint32_t left, uint32_t capacity, bool swap)
{
  cdr_fault_t fault;
  any_sequence_t sequence = {&room[sizeof(room) - (size_t)capacity * WIDTH], 0, capacity};
  cdr_in_t in = {
    &buffer[POSITIONS + LAST - (position + left)], position + left, position, swap, false, &fault};

  if (capacity == 0u) {
    sequence.data = NULL;
  }
  PRIMITIVE(&in, (void *)&sequence, CDR_UNBOUNDED, "any");
  //@ check in.position <= in.size;
  //@ check sequence.size <= capacity;
}

/* A length: `low` (LAST + 1: what is above, below 256), or one of which `unknown` is the highest byte that is not 0. */
static void read_length(uint32_t position, uint32_t left, uint32_t low, uint32_t unknown, bool swap)
{
  const uint32_t place = (position + (LENGTH - 1u)) & ~(LENGTH - 1u);
  const bool reversed = swap == (bool)CDR_HOST_IS_LITTLE_ENDIAN;

  proof_any(buffer, sizeof(buffer));
  for (uint32_t i = 0; i < LENGTH && place + LENGTH <= position + left; ++i) {
    uint8_t * at = &buffer[POSITIONS + LAST - (position + left) + place + (reversed ? LENGTH - 1u - i : i)];

    if (unknown == LENGTH) {
      *at = i != 0u ? 0u : low <= LAST ? (uint8_t)low : (uint8_t)Frama_C_interval(LAST + 1, UINT8_MAX);
    } else if (i == unknown) {
      *at = (uint8_t)Frama_C_interval(1, UINT8_MAX);
    } else if (i > unknown) {
      *at = 0;
    }
  }
  for (uint32_t capacity = 0; capacity <= CAPACITY; ++capacity) {
    read(position, left, capacity, swap);
  }
}

int main(void)
{
  for (uint32_t position = 0; position < POSITIONS; ++position) {
    for (uint32_t left = 0; left <= LAST; ++left) {
      for (uint32_t swap = 0; swap < 2u; ++swap) {
        for (uint32_t low = 0; low <= LAST + 1u; ++low) {
          read_length(position, left, low, LENGTH, swap != 0u);
        }
        for (uint32_t unknown = 1; unknown < LENGTH; ++unknown) {
          read_length(position, left, 0, unknown, swap != 0u);
        }
      }
    }
  }
  return 0;
}
