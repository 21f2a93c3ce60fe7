/* SPDX-License-Identifier: Apache-2.0 */
/* Prints for each combination of the reset flags of the stand-in: the cause, the cause again, and the flags then. */
#include <stdio.h>
#include <stdlib.h>

#include <main.h>
#include <microros/port_diagnosis.h>

volatile uint32_t stm32_reset_flags;

int main(int count, char ** words)
{
  (void)count;
  stm32_reset_flags = (uint32_t)strtoul(words[1], NULL, 0);
  (void)printf("%d", (int)port_reset_cause());
  (void)printf("%d", (int)port_reset_cause());
  (void)printf("%u", (unsigned int)stm32_reset_flags);
  return 0;
}
