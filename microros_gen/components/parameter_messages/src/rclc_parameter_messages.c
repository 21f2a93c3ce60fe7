/* SPDX-License-Identifier: Apache-2.0 */
/* Reads and writes bodies of messages without a struct. */
#include "microros/rclc_parameter_in.h"

#include "microros/cdr.h"
#include "microros/rclc_parameter_out.h"
#include "microros/text.h"

#include <stddef.h>
#include <string.h>

enum { IN_LENGTH = 4 }; /* bytes of the length of a sequence */

const uint8_t * rclc_parameter_in_take(cdr_in_t * in, uint32_t count, uint32_t width)
{
  const uint32_t start = cdr_aligned(in->position, width);

  /* A sample has less than 64 KiB, so a product that is looked at is in range. */
  if (in->failed || start > in->size || count > in->size - start || count * width > in->size - start) {
    cdr_in_refuse(in, CDR_FAULT_END, "message", (uint64_t)count * width, in->size - in->position);
    return NULL;
  }
  in->position = start + count * width;
  return &in->body[start];
}

uint32_t rclc_parameter_in_length(cdr_in_t * in)
{
  return cdr_in_length(in, 1u, "message");
}

/* As in ROS, a string ends at its first NUL or after its length. */
parameter_text_t rclc_parameter_in_text(cdr_in_t * in)
{
  const uint32_t length = rclc_parameter_in_length(in); /* so many bytes are left */
  const uint8_t * bytes = &in->body[in->position];
  parameter_text_t text = {(const char *)bytes, 0};
  uint32_t size = 0;

  while (size < length && bytes[size] != 0u) {
    ++size;
  }
  text.size = size;
  in->position += length;
  return text;
}

void rclc_parameter_in_pass_text(cdr_in_t * in)
{
  const uint32_t length = rclc_parameter_in_length(in); /* so many bytes are left */

  in->position += length;
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

bool rclc_parameter_in_pass_empty(cdr_in_t * in, uint32_t count)
{
  const uint32_t bytes = count * (uint32_t)IN_LENGTH;
  const uint32_t start = cdr_aligned(in->position, (uint32_t)IN_LENGTH);
  const uint8_t * end;

  if (start > in->size || bytes > in->size - start) {
    return false;
  }
  end = &in->body[start + bytes];
  for (const uint8_t * at = &in->body[start]; at != end; at = &at[IN_LENGTH]) {
    uint32_t length;

    (void)memcpy(&length, at, sizeof(length));
    if (length != 0u) { /* 0 in both byte orders */
      return false;
    }
  }
  in->position = start + bytes;
  return true;
}

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
