/* SPDX-License-Identifier: Apache-2.0 */
/* Text functions for names, smaller than those of the C library. */
#ifndef MICROROS_TEXT_H
#define MICROROS_TEXT_H

#include "microros/flash.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the number of bytes before the NUL. */
size_t microros_text_size(const MICROROS_ANYWHERE char * text);

bool microros_text_equals(const MICROROS_ANYWHERE char * a, const MICROROS_ANYWHERE char * b);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_TEXT_H */
