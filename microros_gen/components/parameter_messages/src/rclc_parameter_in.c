/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_in.h"

#include <stddef.h>

const uint8_t * rclc_parameter_in_take(cdr_in_t * in, uint32_t count, uint32_t width)
{
  const uint32_t start = cdr_aligned(in->position, width);
  const uint64_t bytes = (uint64_t)count * width;

  if (in->failed || start > in->size || bytes > (uint64_t)in->size - start) {
    cdr_in_refuse(in, CDR_FAULT_END, "message", bytes, in->size - in->position);
    return NULL;
  }
  in->position = start + (uint32_t)bytes;
  return &in->body[start];
}

uint32_t rclc_parameter_in_length(cdr_in_t * in)
{
  return cdr_in_length(in, 1u, "message");
}

/* As in ROS, a string ends at its first NUL or after its length. */
parameter_text_t rclc_parameter_in_text(cdr_in_t * in)
{
  const uint32_t length = rclc_parameter_in_length(in);
  const uint8_t * bytes = rclc_parameter_in_take(in, length, 1u);
  parameter_text_t text = {"", 0};

  if (bytes != NULL) {
    text.data = (const char *)bytes;
    while (text.size < length && bytes[text.size] != 0u) {
      ++text.size;
    }
  }
  return text;
}

uint32_t rclc_parameter_in_pass(cdr_in_t * in, uint32_t width)
{
  const uint32_t count = cdr_in_length(in, width, "message");

  if (count != 0u) {
    (void)rclc_parameter_in_take(in, count, width);
  }
  return count;
}

uint32_t rclc_parameter_in_pass_texts(cdr_in_t * in)
{
  const uint32_t count = rclc_parameter_in_length(in);

  for (uint32_t i = 0; i < count && !in->failed; ++i) {
    (void)rclc_parameter_in_text(in);
  }
  return count;
}
