/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers as texts, for reasons. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_SHOW_H
#define MICROROS_RCLC_PARAMETER_SHOW_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes of the longest one: an int64_t with its sign. No NUL follows. */
enum { PARAMETER_SHOWN_MAX = 20 };

/* Write a number to `to`, which has PARAMETER_SHOWN_MAX bytes; return how many it takes. */
uint32_t rclc_parameter_show_integer(char * to, int64_t value);

/* As printf does for %g: six digits. */
uint32_t rclc_parameter_show_double(char * to, double value);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_SHOW_H */
