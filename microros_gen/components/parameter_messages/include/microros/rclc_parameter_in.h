/* SPDX-License-Identifier: Apache-2.0 */
/* Reads parts of messages of parameters in place. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_IN_H
#define MICROROS_RCLC_PARAMETER_IN_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/cdr_decode.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A string inside a message, without a NUL. */
typedef struct parameter_text_t {
  const char * data;
  uint32_t size;
} parameter_text_t;

/* Read one member and move on. */
uint32_t rclc_parameter_in_length(cdr_in_t * in);
parameter_text_t rclc_parameter_in_text(cdr_in_t * in);

/* Returns a pointer to `count` elements of `width` bytes and skips them; NULL if the body is too short. */
const uint8_t * rclc_parameter_in_take(cdr_in_t * in, uint32_t count, uint32_t width);

/* Skips a string. */
void rclc_parameter_in_pass_text(cdr_in_t * in);

/* Skip a sequence of numbers or of strings; return the number of its elements. */
uint32_t rclc_parameter_in_pass(cdr_in_t * in, uint32_t width);
uint32_t rclc_parameter_in_pass_texts(cdr_in_t * in);

/* Skips `count` sequences if all of them are empty; otherwise returns false and skips nothing. */
bool rclc_parameter_in_pass_empty(cdr_in_t * in, uint32_t count);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_IN_H */
