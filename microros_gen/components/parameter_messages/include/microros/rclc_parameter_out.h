/* SPDX-License-Identifier: Apache-2.0 */
/* Writes parts of messages of parameters as CDR, within the size of a message. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_OUT_H
#define MICROROS_RCLC_PARAMETER_OUT_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/rclc_parameter_in.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A body that is being written. A part that does not fit is left out, and `full` is set. */
typedef struct parameter_out_t {
  uint8_t * body;
  uint32_t position;
  uint32_t room; /* bytes of the body at most */
  bool full;
} parameter_out_t;

/* Returns the place for `bytes` with the alignment `width`, after its padding, and moves past it; NULL: no room. */
uint8_t * rclc_parameter_out_take(parameter_out_t * out, uint32_t width, uint32_t bytes);

void rclc_parameter_out_1(parameter_out_t * out, uint8_t value);
void rclc_parameter_out_4(parameter_out_t * out, uint32_t value);

/* Writes 8 bytes of any type. */
void rclc_parameter_out_8(parameter_out_t * out, const void * value);

/* Writes `bytes` with the alignment `width`. */
void rclc_parameter_out_bytes(parameter_out_t * out, uint32_t width, const void * from, uint32_t bytes);

/* Begin a sequence whose length is known at its end: the first returns what the second takes. */
uint32_t rclc_parameter_out_begin(parameter_out_t * out);
void rclc_parameter_out_end(parameter_out_t * out, uint32_t at, uint32_t count);

/* Writes a string that consists of several parts. */
void rclc_parameter_out_parts(parameter_out_t * out, const parameter_text_t * parts, uint32_t count);
void rclc_parameter_out_text(parameter_out_t * out, const char * text);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_OUT_H */
