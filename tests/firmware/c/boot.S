/* SPDX-License-Identifier: Apache-2.0 */
/* A bootloader at address 0: spoils the memory that the image expects to be cleared by itself, and starts the image. */
  .syntax unified
  .thumb
  .text
  .word 0x20001000
  .word reset + 1

  .type reset, %function
reset:
  ldr r0, =BOOT_SPOILED
  movs r1, #255
  ldr r2, =4096
spoil:
  strb r1, [r0]
  adds r0, r0, #1
  subs r2, r2, #1
  bne spoil
  ldr r0, =BOOT_IMAGE
  ldr r1, [r0]
  mov sp, r1
  ldr r1, [r0, #4]
  bx r1
  .ltorg
