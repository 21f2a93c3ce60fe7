/* SPDX-License-Identifier: Apache-2.0 */
/* The end of a program on a Cortex-M that ends the emulator by semihosting (SYS_EXIT_EXTENDED). */
#ifndef EMULATOR_END_H
#define EMULATOR_END_H

#include <stdbool.h>
#include <stdint.h>

enum { SYS_EXIT_EXTENDED = 0x20, APPLICATION_EXIT = 0x20026 };

static void end(uint32_t status)
{
  const uint32_t block[2] = {APPLICATION_EXIT, status};
  register uint32_t operation __asm__("r0") = SYS_EXIT_EXTENDED;
  register const uint32_t * reason __asm__("r1") = block;

  __asm volatile("bkpt 0xab" : : "r"(operation), "r"(reason) : "memory");
  for (;;) {
  }
}

static void check(bool holds, uint32_t status)
{
  if (!holds) {
    end(status);
  }
}

#endif /* EMULATOR_END_H */
