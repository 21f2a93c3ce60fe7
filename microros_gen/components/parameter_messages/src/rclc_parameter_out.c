/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_out.h"

#include "microros/cdr.h"
#include "microros/text.h"

#include <stddef.h>

uint8_t * rclc_parameter_out_take(parameter_out_t * out, uint32_t width, uint32_t bytes)
{
  const uint32_t start = cdr_aligned(out->position, width);
  uint8_t * body = out->body;

  if (start > out->room || bytes > out->room - start) {
    out->full = true;
    return NULL;
  }
  for (uint32_t i = out->position; i < start; ++i) {
    body[i] = 0; /* mostly none: a call of memset for each member would take longer than the member */
  }
  out->position = start + bytes;
  return &body[start];
}

void rclc_parameter_out_1(parameter_out_t * out, uint8_t value)
{
  uint8_t * to = rclc_parameter_out_take(out, 1u, 1u);

  if (to != NULL) {
    *to = value;
  }
}

void rclc_parameter_out_4(parameter_out_t * out, uint32_t value)
{
  uint8_t * to = rclc_parameter_out_take(out, 4u, 4u);

  if (to != NULL) {
    cdr_put_4(to, &value);
  }
}

uint32_t rclc_parameter_out_begin(parameter_out_t * out)
{
  rclc_parameter_out_4(out, 0u);
  return out->position - 4u;
}

void rclc_parameter_out_end(parameter_out_t * out, uint32_t at, uint32_t count)
{
  if (!out->full) {
    cdr_put_4(&out->body[at], &count);
  }
}

void rclc_parameter_out_8(parameter_out_t * out, const void * value)
{
  uint8_t * to = rclc_parameter_out_take(out, 8u, 8u);

  if (to != NULL) {
    cdr_put_8(to, value);
  }
}

void rclc_parameter_out_bytes(parameter_out_t * out, uint32_t width, const void * from, uint32_t bytes)
{
  uint8_t * to = rclc_parameter_out_take(out, width, bytes);

  if (to != NULL) {
    cdr_copy(to, from, (size_t)bytes);
  }
}

void rclc_parameter_out_parts(parameter_out_t * out, const parameter_text_t * parts, uint32_t count)
{
  uint32_t size = 1; /* the NUL */
  uint8_t * to;

  for (uint32_t i = 0; i < count; ++i) {
    size += parts[i].size;
  }
  to = rclc_parameter_out_take(out, 4u, 4u + size);
  if (to == NULL) {
    return;
  }
  cdr_put_4(to, &size);
  to = &to[4];
  for (uint32_t i = 0; i < count; ++i) {
    cdr_copy(to, parts[i].data, (size_t)parts[i].size);
    to = &to[parts[i].size];
  }
  *to = 0;
}

void rclc_parameter_out_text(parameter_out_t * out, const char * text)
{
  const parameter_text_t part = {text, (uint32_t)microros_text_size(text)};

  rclc_parameter_out_parts(out, &part, 1u);
}
