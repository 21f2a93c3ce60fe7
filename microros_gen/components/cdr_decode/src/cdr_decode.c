/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/cdr_decode.h"

#include "microros/cdr_loan.h"

#include <string.h>

/* Common layout of all sequences: those of rosidl_runtime_c differ only in the type of `data`. */
typedef struct sequence_t {
  void * data;
  size_t size;
  size_t capacity;
} sequence_t;

CDR_STATIC_ASSERT(cdr_assert_pointers_have_one_size, sizeof(void *) == sizeof(double *));
CDR_STATIC_ASSERT(cdr_assert_bool_has_8_bits, sizeof(bool) == 1U);

bool cdr_decode(
  const microros_message_type_t * type, const uint8_t * body, uint32_t size, bool swap, void * message,
  cdr_fault_t * fault)
{
  cdr_in_t in = {body, size, 0U, swap, false, fault};

  type->decode(&in, message);
  return !in.failed;
}

void cdr_in_refuse(cdr_in_t * in, cdr_fault_kind_t kind, const char * field, uint64_t found, uint32_t fits)
{
  if (!in->failed) {
    in->failed = true;
    in->fault->field = field;
    in->fault->within = NULL;
    in->fault->found = (found > UINT32_MAX) ? UINT32_MAX : (uint32_t)found;
    in->fault->fits = fits;
    in->fault->index = CDR_NO_INDEX;
    in->fault->kind = kind;
    in->fault->depth = 0U;
  }
  in->position = in->size;
}

void cdr_in_refuse_above(cdr_in_t * in, const char * field, uint32_t found, uint32_t limit, uint32_t bound)
{
  cdr_in_refuse(in, (limit < bound) ? CDR_FAULT_CAPACITY : CDR_FAULT_BOUND, field, found, limit);
}

void cdr_in_within(const cdr_in_t * in, const char * member, size_t index)
{
  (void)cdr_refuse_within(in->fault, member, index);
}

/**
 * Returns the address of `count` values of `width` bytes (1, 2, 4 or 8) after their padding, and advances.
 * Returns NULL, with the fault filled, if the body ends before them.
 */
static inline const uint8_t * take(cdr_in_t * in, size_t count, uint32_t width, const char * field)
{
  const uint32_t padding = (0U - in->position) & (width - 1U);
  const uint32_t left = in->size - in->position;
  const uint64_t bytes = ((uint64_t)count * width) + padding;

  if (bytes > left) {
    cdr_in_refuse(in, CDR_FAULT_END, field, bytes, left);
    return NULL;
  }
  const uint8_t * const from = &in->body[in->position + padding];
  in->position += (uint32_t)bytes;
  return from;
}

/** Reverses the bytes of each of the numbers of `width` bytes (2, 4 or 8) that take `size` bytes. */
static void turn(uint8_t * numbers, size_t size, uint32_t width)
{
  for (size_t i = 0U; i < size; ++i) { /* at most BYTES_READ rounds */
    const size_t mirrored = i ^ ((size_t)width - 1U);
    if (i < mirrored) {
      const uint8_t byte = numbers[i];
      numbers[i] = numbers[mirrored];
      numbers[mirrored] = byte;
    }
  }
}

static inline void get_numbers(cdr_in_t * in, void * to, size_t count, uint32_t width, const char * field)
{
  if (count == 0U) {
    return;
  }
  const uint8_t * const from = take(in, count, width, field);
  if (from == NULL) {
    return;
  }
  const size_t size = count * (size_t)width;
  (void)memcpy(to, from, size); /* at most BYTES_READ bytes */
  if (in->swap) {
    turn((uint8_t *)to, size, width);
  }
}

void cdr_get_1(cdr_in_t * in, void * to, size_t count, const char * field)
{
  get_numbers(in, to, count, 1U, field);
}

void cdr_get_2(cdr_in_t * in, void * to, size_t count, const char * field)
{
  get_numbers(in, to, count, 2U, field);
}

void cdr_get_4(cdr_in_t * in, void * to, size_t count, const char * field)
{
  get_numbers(in, to, count, 4U, field);
}

void cdr_get_8(cdr_in_t * in, void * to, size_t count, const char * field)
{
  get_numbers(in, to, count, 8U, field);
}

void cdr_get_bool(cdr_in_t * in, bool * to, size_t count, const char * field)
{
  const uint8_t * const from = take(in, count, 1U, field);

  /* at most BYTES_READ rounds */
  for (size_t i = 0U; (from != NULL) && (i < count); ++i) {
    to[i] = from[i] != 0U;
  }
}

/** Returns a number with its bytes reversed. */
static inline uint32_t turned(uint32_t number)
{
  return (number >> 24U) | ((number >> 8U) & 0xFF00U) | ((number << 8U) & 0xFF0000U) | (number << 24U);
}

uint32_t cdr_in_length(cdr_in_t * in, uint32_t width, const char * field)
{
  const uint32_t bytes = ((0U - in->position) & 3U) + 4U; /* its padding, and the length */
  uint32_t left = in->size - in->position;                /* 0 after a fault */
  uint32_t length = 0U;

  if (left < bytes) {
    cdr_in_refuse(in, CDR_FAULT_END, field, bytes, left);
    return 0U;
  }
  in->position += bytes;
  left -= bytes;
  (void)memcpy(&length, &in->body[in->position - 4U], sizeof(length));
  if (in->swap) {
    length = turned(length);
  }
  if ((length > left) || ((width > 1U) && (((uint64_t)length * width) > left))) {
    cdr_in_refuse(in, CDR_FAULT_END, field, (uint64_t)length * width, left);
    return 0U;
  }
  return length;
}

/** Reads the length of a sequence of elements of at least `width` bytes; returns where to store them. */
static void * get_size(
  cdr_in_t * in, void * sequence, uint32_t bound, uint32_t width, const char * field, uint32_t * size)
{
  sequence_t known;
  uint32_t length = cdr_in_length(in, width, field);

  (void)memcpy(&known, sequence, sizeof(known));
  const uint32_t limit = cdr_in_limit((known.data == NULL) ? 0U : known.capacity, bound);
  if (length > limit) {
    cdr_in_refuse_above(in, field, length, limit, bound);
    length = 0U;
  }
  known.size = (size_t)length;
  (void)memcpy(sequence, &known, sizeof(known));
  *size = length;
  return known.data;
}

void cdr_get_size(cdr_in_t * in, void * sequence, uint32_t bound, const char * field)
{
  uint32_t size;

  (void)get_size(in, sequence, bound, 1U, field, &size);
}

static void get_sequence(cdr_in_t * in, void * sequence, uint32_t bound, uint32_t width, const char * field)
{
  if (!cdr_loan_sequence(in, sequence, bound, width, field)) {
    uint32_t size;
    void * const data = get_size(in, sequence, bound, width, field, &size);

    get_numbers(in, data, (size_t)size, width, field);
  }
}

void cdr_get_sequence_1(cdr_in_t * in, void * sequence, uint32_t bound, const char * field)
{
  get_sequence(in, sequence, bound, 1U, field);
}

void cdr_get_sequence_2(cdr_in_t * in, void * sequence, uint32_t bound, const char * field)
{
  get_sequence(in, sequence, bound, 2U, field);
}

void cdr_get_sequence_4(cdr_in_t * in, void * sequence, uint32_t bound, const char * field)
{
  get_sequence(in, sequence, bound, 4U, field);
}

void cdr_get_sequence_8(cdr_in_t * in, void * sequence, uint32_t bound, const char * field)
{
  get_sequence(in, sequence, bound, 8U, field);
}

void cdr_get_sequence_bool(cdr_in_t * in, void * sequence, uint32_t bound, const char * field)
{
  uint32_t size;
  bool * const data = (bool *)get_size(in, sequence, bound, 1U, field, &size);

  cdr_get_bool(in, data, (size_t)size, field);
}
