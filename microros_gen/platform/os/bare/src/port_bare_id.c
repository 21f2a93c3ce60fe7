/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_board.h"

enum { BITS_PER_BYTE = 8, BYTES_PER_WORD = 4 };

/* FNV-1a over the bytes of the unique id, least significant first. */
uint32_t port_unique_id(void)
{
  const volatile uint32_t * const words = (const volatile uint32_t *)PORT_BOARD_ID;
  uint32_t hash = 2166136261u;

  for (uint32_t i = 0; i < PORT_BOARD_ID_WORDS; ++i) {
    uint32_t word = words[i];

    for (uint32_t byte = 0; byte < BYTES_PER_WORD; ++byte) {
      hash = (hash ^ (word & 0xffu)) * 16777619u;
      word >>= BITS_PER_BYTE;
    }
  }
  return hash == 0u ? 1u : hash;
}
