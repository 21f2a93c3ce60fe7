/* SPDX-License-Identifier: Apache-2.0 */
/* The breakpoint instruction with the number that debuggers recognize as semihosting. */
  .syntax unified
  .thumb

  .section .text.port_bare_semihosting, "ax", %progbits
  .global port_bare_semihosting
  .type port_bare_semihosting, %function
  .thumb_func
port_bare_semihosting:
  bkpt 0xab
  bx lr
  .size port_bare_semihosting, . - port_bare_semihosting
