/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/cdr_loan.h"

#include <string.h>

/* Common layout of all sequences, as in cdr_decode.c. */
typedef struct loan_sequence_t {
  void * data;
  size_t size;
  size_t capacity;
} loan_sequence_t;

enum { LENGTH_SIZE = 4 };

/* The body that is being read; NULL: none. A decoder that reads another one has another fault. */
static uint8_t * loan_body;
static const cdr_fault_t * loan_fault;

bool cdr_loan_decode(
  const microros_message_type_t * type, uint8_t * body, uint32_t size, bool swap, void * message,
  cdr_fault_t * fault)
{
  bool done;

  loan_body = body;
  loan_fault = fault;
  done = cdr_decode(type, body, size, swap, message, fault);
  loan_body = NULL;
  loan_fault = NULL;
  return done;
}

static bool loan_is_of(const cdr_in_t * in)
{
  return loan_body != NULL && in->fault == loan_fault;
}

/* Moves a string over its length if its last byte is none; returns its first character. */
static char * loan_terminate(uint8_t * text, uint32_t length)
{
  uint8_t * first = text;

  if (length == 0u) {
    first = &text[-1]; /* a byte of the length, which is 0 */
  } else if (text[length - 1u] != 0u) {
    first = &text[-1];
    (void)memmove(first, text, (size_t)length); /* at most BYTES_READ bytes */
    first[length] = 0u;
  } else {
    /* usual */
  }
  return (char *)first;
}

bool cdr_loan_string(cdr_in_t * in, rosidl_runtime_c__String * text, uint32_t bound, const char * field)
{
  uint32_t length;

  if (!loan_is_of(in)) {
    return false;
  }
  length = cdr_in_length(in, 1U, field);
  if (in->failed) {
    return true;
  }
  text->data = loan_terminate(&loan_body[in->position], length);
  text->size = strlen(text->data); /* at most BYTES_READ bytes */
  text->capacity = text->size + 1u;
  in->position += length;
  if (text->size > bound) {
    cdr_in_refuse_above(in, field, (uint32_t)text->size, bound, bound);
  }
  return true;
}

/* Reverses the bytes of each number. */
static void loan_swap(uint8_t * numbers, uint32_t count, uint32_t width)
{
  for (uint32_t i = 0; i < count; ++i) { /* at most BYTES_READ rounds */
    uint8_t * number = &numbers[(size_t)i * width];

    for (uint32_t first = 0; first < width / 2u; ++first) { /* at most 4 rounds */
      const uint8_t byte = number[first];

      number[first] = number[width - 1u - first];
      number[width - 1u - first] = byte;
    }
  }
}

/* Returns the address of numbers that need at most four bytes less to be aligned: the length is before them. */
static uint8_t * loan_align(uint8_t * numbers, size_t size, uint32_t width)
{
  const uintptr_t off = (uintptr_t)numbers & ((uintptr_t)width - 1u);
  uint8_t * aligned = numbers;

  if (off != 0u && off <= (uintptr_t)LENGTH_SIZE) {
    aligned = &numbers[-(ptrdiff_t)off];
    (void)memmove(aligned, numbers, size); /* at most BYTES_READ bytes */
  }
  return aligned;
}

bool cdr_loan_sequence(cdr_in_t * in, void * sequence, uint32_t bound, uint32_t width, const char * field)
{
  loan_sequence_t found = {NULL, 0u, 0u};
  uint32_t padding;
  uint32_t count;

  if (!loan_is_of(in)) {
    return false;
  }
  count = cdr_in_length(in, width, field);
  if (count > bound) {
    const uint32_t limit = bound;

    cdr_in_refuse_above(in, field, count, limit, bound);
    count = 0;
  }
  padding = (0U - in->position) & (width - 1U);
  if (count != 0u && (uint64_t)padding + (uint64_t)count * width > (uint64_t)in->size - in->position) {
    cdr_in_refuse(
      in, CDR_FAULT_END, field, (uint64_t)padding + (uint64_t)count * width, in->size - in->position);
    count = 0;
  }
  if (count != 0u) {
    uint8_t * numbers = &loan_body[in->position + padding];

    in->position += padding + count * width;
    if (in->swap) {
      loan_swap(numbers, count, width);
    }
    found.data = loan_align(numbers, (size_t)count * (size_t)width, width);
    found.size = (size_t)count;
    found.capacity = (size_t)count;
  }
  (void)memcpy(sequence, &found, sizeof(found));
  return true;
}
