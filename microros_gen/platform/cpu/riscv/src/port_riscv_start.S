/* SPDX-License-Identifier: Apache-2.0 */
/* The first instructions after a reset, and the code that saves registers around a trap. Control and status
 * registers: The RISC-V Instruction Set Manual, Volume II, "Machine-Level ISA". */
  .option arch, +zicsr
  .section .text.port_riscv_reset, "ax", @progbits
  .global port_riscv_reset
  .type port_riscv_reset, @function
port_riscv_reset:
  csrw mie, zero
  .option push
  .option norelax
  la gp, __global_pointer$
  .option pop
  la t0, port_stack_low
  la sp, port_stack_high
  li t1, 0xc5c5c5c5
paint:
  sw t1, 0(t0)
  addi t0, t0, 4
  bltu t0, sp, paint
  la t0, port_riscv_trap_entry
  csrw mtvec, t0
  call port_bare_start
  .size port_riscv_reset, . - port_riscv_reset

  .section .text.port_riscv_trap_entry, "ax", @progbits
  .type port_riscv_trap_entry, @function
  .balign 4
port_riscv_trap_entry:
  addi sp, sp, -64
  sw ra, 0(sp)
  sw t0, 4(sp)
  sw t1, 8(sp)
  sw t2, 12(sp)
  sw t3, 16(sp)
  sw t4, 20(sp)
  sw t5, 24(sp)
  sw t6, 28(sp)
  sw a0, 32(sp)
  sw a1, 36(sp)
  sw a2, 40(sp)
  sw a3, 44(sp)
  sw a4, 48(sp)
  sw a5, 52(sp)
  sw a6, 56(sp)
  sw a7, 60(sp)
  csrr a0, mcause
  csrr a1, mepc
  csrr a2, mtval
  call port_riscv_trap
  lw ra, 0(sp)
  lw t0, 4(sp)
  lw t1, 8(sp)
  lw t2, 12(sp)
  lw t3, 16(sp)
  lw t4, 20(sp)
  lw t5, 24(sp)
  lw t6, 28(sp)
  lw a0, 32(sp)
  lw a1, 36(sp)
  lw a2, 40(sp)
  lw a3, 44(sp)
  lw a4, 48(sp)
  lw a5, 52(sp)
  lw a6, 56(sp)
  lw a7, 60(sp)
  addi sp, sp, 64
  mret
  .size port_riscv_trap_entry, . - port_riscv_trap_entry

  .section .text.port_riscv_interrupts_on, "ax", @progbits
  .global port_riscv_interrupts_on
  .type port_riscv_interrupts_on, @function
port_riscv_interrupts_on:
  li t0, 0x880 /* machine timer, machine external */
  csrs mie, t0
  csrsi mstatus, 8
  ret
  .size port_riscv_interrupts_on, . - port_riscv_interrupts_on
