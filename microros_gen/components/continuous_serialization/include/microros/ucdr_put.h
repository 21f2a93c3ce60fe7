/* SPDX-License-Identifier: Apache-2.0 */
/* What all functions that write values call. Internal. */
#ifndef MICROROS_UCDR_PUT_H
#define MICROROS_UCDR_PUT_H

#include "ucdr/microcdr.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes `count` values of `size` bytes (1, 2, 4 or 8), of which only the first needs padding. */
bool ucdr_put(ucdrBuffer * ub, const void * values, size_t size, size_t count);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_UCDR_PUT_H */
