/* SPDX-License-Identifier: Apache-2.0 */
/* Text functions for names, smaller than those of the C library. */
#ifndef MICROROS_TEXT_H
#define MICROROS_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the number of bytes before the NUL. */
size_t microros_text_size(const char * text);

bool microros_text_equals(const char * a, const char * b);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_TEXT_H */
