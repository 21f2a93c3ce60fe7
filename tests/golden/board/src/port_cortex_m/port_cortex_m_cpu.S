/* SPDX-License-Identifier: Apache-2.0 */
/* An instruction that C cannot express. */
  .syntax unified
  .thumb

  .section .text.port_bare_wait, "ax", %progbits
  .global port_bare_wait
  .type port_bare_wait, %function
  .thumb_func
port_bare_wait:
  dsb
  wfi
  bx lr
  .size port_bare_wait, . - port_bare_wait
