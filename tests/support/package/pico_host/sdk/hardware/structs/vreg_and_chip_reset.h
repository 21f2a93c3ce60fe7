/* SPDX-License-Identifier: Apache-2.0 */
#ifndef HARDWARE_STRUCTS_VREG_AND_CHIP_RESET_H
#define HARDWARE_STRUCTS_VREG_AND_CHIP_RESET_H

#include <stdint.h>

#define VREG_AND_CHIP_RESET_CHIP_RESET_HAD_RUN_BITS 0x00010000u
#define VREG_AND_CHIP_RESET_CHIP_RESET_HAD_POR_BITS 0x00000100u

typedef struct {
  volatile uint32_t chip_reset;
} vreg_and_chip_reset_hw_t;

vreg_and_chip_reset_hw_t * pico_chip_reset(void);

#define vreg_and_chip_reset_hw (pico_chip_reset())

#endif /* HARDWARE_STRUCTS_VREG_AND_CHIP_RESET_H */
