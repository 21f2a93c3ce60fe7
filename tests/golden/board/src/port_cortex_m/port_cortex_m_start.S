/* SPDX-License-Identifier: Apache-2.0 */
/* Code that runs without a stack: fills it with a pattern after a reset, and leaves it after an overflow. */
  .syntax unified
  .thumb

  .section .text.port_cortex_m_reset, "ax", %progbits
  .global port_cortex_m_reset
  .type port_cortex_m_reset, %function
  .thumb_func
port_cortex_m_reset:
  ldr r0, =port_stack_low
  ldr r1, =port_stack_high
  ldr r2, =0xc5c5c5c5
paint:
  str r2, [r0]
  adds r0, r0, #4
  cmp r0, r1
  blo paint
  mov sp, r1
  bl port_bare_start
  .ltorg
  .size port_cortex_m_reset, . - port_cortex_m_reset

  .section .text.port_cortex_m_fault, "ax", %progbits
  .global port_cortex_m_fault
  .type port_cortex_m_fault, %function
  .thumb_func
port_cortex_m_fault:
  mrs r0, msp
  ldr r1, =port_stack_low
  cmp r0, r1
  bhs readable
  ldr r1, =port_stack_high
  mov sp, r1
  movs r0, #0
readable:
  bl port_cortex_m_fault_record
  .ltorg
  .size port_cortex_m_fault, . - port_cortex_m_fault
