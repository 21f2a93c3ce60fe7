/* SPDX-License-Identifier: Apache-2.0 */
/* The three adjacent, uncompressed instructions that debuggers recognize as semihosting. */
  .section .text.port_bare_semihosting, "ax", @progbits
  .global port_bare_semihosting
  .type port_bare_semihosting, @function
  .balign 16
port_bare_semihosting:
  .option push
  .option norvc
  slli x0, x0, 0x1f
  ebreak
  srai x0, x0, 7
  .option pop
  ret
  .size port_bare_semihosting, . - port_bare_semihosting
