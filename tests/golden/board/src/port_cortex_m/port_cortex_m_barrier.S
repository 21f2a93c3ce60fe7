/* SPDX-License-Identifier: Apache-2.0 */
/* Instructions that C cannot express. */
  .syntax unified
  .thumb

  .section .text.port_cortex_m_barrier, "ax", %progbits
  .global port_cortex_m_barrier
  .type port_cortex_m_barrier, %function
  .thumb_func
port_cortex_m_barrier:
  dsb
  isb
  bx lr
  .size port_cortex_m_barrier, . - port_cortex_m_barrier
