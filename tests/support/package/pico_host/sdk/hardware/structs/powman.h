/* SPDX-License-Identifier: Apache-2.0 */
#ifndef HARDWARE_STRUCTS_POWMAN_H
#define HARDWARE_STRUCTS_POWMAN_H

#include <stdint.h>

#define POWMAN_CHIP_RESET_HAD_POR_BITS 0x00010000u
#define POWMAN_CHIP_RESET_HAD_BOR_BITS 0x00020000u
#define POWMAN_CHIP_RESET_HAD_RUN_LOW_BITS 0x00040000u

typedef struct {
  volatile uint32_t chip_reset;
} powman_hw_t;

powman_hw_t * pico_chip_reset(void);

#define powman_hw (pico_chip_reset())

#endif /* HARDWARE_STRUCTS_POWMAN_H */
