/* SPDX-License-Identifier: Apache-2.0 */
/* An instruction that C cannot express. */
  .section .text.port_bare_wait, "ax", @progbits
  .global port_bare_wait
  .type port_bare_wait, @function
port_bare_wait:
  wfi
  ret
  .size port_bare_wait, . - port_bare_wait
