/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Constants in program memory. A processor whose loads reach RAM alone (AVR) copies every constant there before
 * main(). One that is declared with MICROROS_FLASH is not copied; each pointer to it is declared with it, too, so that
 * the compiler reads it with the instruction for program memory. For every other processor the word is empty.
 *
 * avr-gcc has such pointers in its own C (-std=gnu99), neither in ISO C nor in C++, where a pointer of this kind can
 * be passed on but not read.
 */
#ifndef MICROROS_FLASH_H
#define MICROROS_FLASH_H

#ifdef __FLASH
#define MICROROS_FLASH __flash
/* A pointer to a string literal in program memory. */
#define MICROROS_FLASH_TEXT(words) \
  __extension__({ \
    static const __flash char flash_text[] = words; \
    &flash_text[0]; \
  })
#else
#define MICROROS_FLASH
#define MICROROS_FLASH_TEXT(words) (words)
#endif

#endif /* MICROROS_FLASH_H */
