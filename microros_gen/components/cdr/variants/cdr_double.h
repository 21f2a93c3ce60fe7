/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_CDR_DOUBLE_H
#define MICROROS_CDR_DOUBLE_H

/**
 * @file float64 members where a `double` has 4 bytes (binary32, as on AVR): on the wire they have 8 (binary64).
 *
 * To the wire every number is exact. From the wire it becomes the nearest binary32, ties to even (IEEE 754,
 * 4.3.1): about 7 decimal digits are kept; from 3.4028236e38 on it is an infinity, up to 7.0e-46
 * zero, each with its sign. A NaN stays a NaN, quiet or signaling, with the upper 23 bits of its fraction.
 */

#include <stddef.h>
#include <stdint.h>

#include "microros/cdr.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Writes the binary32 with these bits as binary64: 8 bytes, little endian. */
void cdr_double_widen(uint8_t * to, uint32_t bits);

/** Returns the bits of the binary32 nearest to the binary64 whose upper and lower 32 bits are these. */
uint32_t cdr_double_narrow(uint32_t upper, uint32_t lower);

/** Writes a double. */
void cdr_put_double(uint8_t * to, double value);

/** Writes `count` consecutive doubles. */
void cdr_put_array_double(uint8_t * to, const double * from, size_t count);

/** Writes a sequence of doubles at `position` (a multiple of 4); returns the position after it. */
uint32_t cdr_put_sequence_double(uint8_t * body, uint32_t position, const double * data, size_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_CDR_DOUBLE_H */
