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

/* With -std=c99, avr-gcc defines __FLASH, but does not know the word. */
#if defined(__FLASH) && !defined(__STRICT_ANSI__)
#define MICROROS_FLASH_IS_SEPARATE
#define MICROROS_FLASH __flash
/* What a parameter points to that takes texts in RAM and in program memory: 3 bytes, so in no structure. */
#define MICROROS_ANYWHERE __memx
/* A pointer to a string literal in program memory. */
#define MICROROS_FLASH_TEXT(words) \
  __extension__({ \
    static const __flash char flash_text[] = words; \
    &flash_text[0]; \
  })
/* The same for an initializer outside of functions. */
#define MICROROS_FLASH_NAME(words) ((const __flash char[]){words})
#else
#define MICROROS_FLASH
#define MICROROS_ANYWHERE
#define MICROROS_FLASH_TEXT(words) (words)
#define MICROROS_FLASH_NAME(words) (words)
#endif

#endif /* MICROROS_FLASH_H */
