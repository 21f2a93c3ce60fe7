/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_UCDR_MICROCDR_H
#define MICROROS_UCDR_MICROCDR_H

/**
 * @file The calls of Micro CDR that a callback of continuous serialization makes: serialization into a buffer that is
 * emptied while it is written. Reading is not among them.
 *
 * A buffer belongs to one task at a time. Nothing is allocated, and no pointer to a value is kept. Every function that
 * returns bool returns false after an error, and from then on writes nothing more; `error` stays set.
 */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Byte order of numbers. */
typedef enum ucdrEndianness { UCDR_BIG_ENDIANNESS = 0, UCDR_LITTLE_ENDIANNESS = 1 } ucdrEndianness;

struct ucdrBuffer;

/** Called when a byte more does not fit: makes room between `iterator` and `final`. Returns true if it could not. */
typedef bool (*OnFullBuffer)(struct ucdrBuffer * ub, void * args);

/**
 * Bytes from `init` to `final`, of which those before `iterator` are written. `offset` is the position of the next byte
 * in the whole stream, from which values are aligned. To overwrite the last bytes, subtract their number from
 * `iterator` and `offset`: possible as long as they are in the buffer.
 */
typedef struct ucdrBuffer {
  uint8_t * init;
  uint8_t * final;
  uint8_t * iterator;
  size_t origin; /**< position of `init` in the stream when the buffer was initialized or reset */
  size_t offset;
  ucdrEndianness endianness;
  uint8_t last_data_size; /**< size of the last value, in bytes */
  bool error;
  OnFullBuffer on_full_buffer; /**< NULL: what does not fit is an error */
  void * args;                 /**< passed to on_full_buffer */
} ucdrBuffer;

/** Begins at `data`, of `size` bytes, in the byte order of the machine; the buffer does not own `data`. */
void ucdr_init_buffer(ucdrBuffer * ub, uint8_t * data, size_t size);

/** Same for the part of a stream that begins at its byte `origin`. */
void ucdr_init_buffer_origin(ucdrBuffer * ub, uint8_t * data, size_t size, size_t origin);

/** Same; the first `offset` bytes of `data` are already written. */
void ucdr_init_buffer_origin_offset(
  ucdrBuffer * ub, uint8_t * data, size_t size, size_t origin, size_t offset);

/** Same, in the given byte order. */
void ucdr_init_buffer_origin_offset_endian(
  ucdrBuffer * ub, uint8_t * data, size_t size, size_t origin, size_t offset, ucdrEndianness endianness);

/** Copies the state; both then write to the same bytes. */
void ucdr_copy_buffer(ucdrBuffer * ub_dest, const ucdrBuffer * ub_source);

/** Sets what makes room in a full buffer, and its argument. */
void ucdr_set_on_full_buffer_callback(ucdrBuffer * ub, OnFullBuffer on_full_buffer, void * args);

/** Begins again at `init`, without an error. */
void ucdr_reset_buffer(ucdrBuffer * ub);

/** Same, `offset` bytes after `init`. */
void ucdr_reset_buffer_offset(ucdrBuffer * ub, size_t offset);

/** Writes zeros up to the next multiple of `alignment` (1, 2, 4 or 8) of the stream. */
void ucdr_align_to(ucdrBuffer * ub, size_t alignment);

/** Returns the bytes between `buffer_position` and the next multiple of `data_size` (1, 2, 4 or 8). */
size_t ucdr_alignment(size_t buffer_position, size_t data_size);

/** Same for the position of a buffer. */
size_t ucdr_buffer_alignment(const ucdrBuffer * ub, size_t data_size);

/** Leaves out `size` bytes as they are, which must fit. */
void ucdr_advance_buffer(ucdrBuffer * ub, size_t size);

/** Returns the bytes of the whole buffer. */
size_t ucdr_buffer_size(const ucdrBuffer * ub);

/** Returns the written bytes of the buffer. */
size_t ucdr_buffer_length(const ucdrBuffer * ub);

/** Returns the bytes that fit without making room. */
size_t ucdr_buffer_remaining(const ucdrBuffer * ub);

/** Returns the byte order of numbers. */
ucdrEndianness ucdr_buffer_endianness(const ucdrBuffer * ub);

/** Returns whether an error has happened. */
bool ucdr_buffer_has_error(const ucdrBuffer * ub);

/** Write one value, aligned to its size. */
bool ucdr_serialize_char(ucdrBuffer * ub, char value);
bool ucdr_serialize_bool(ucdrBuffer * ub, bool value);
bool ucdr_serialize_uint8_t(ucdrBuffer * ub, uint8_t value);
bool ucdr_serialize_uint16_t(ucdrBuffer * ub, uint16_t value);
bool ucdr_serialize_uint32_t(ucdrBuffer * ub, uint32_t value);
bool ucdr_serialize_uint64_t(ucdrBuffer * ub, uint64_t value);
bool ucdr_serialize_int8_t(ucdrBuffer * ub, int8_t value);
bool ucdr_serialize_int16_t(ucdrBuffer * ub, int16_t value);
bool ucdr_serialize_int32_t(ucdrBuffer * ub, int32_t value);
bool ucdr_serialize_int64_t(ucdrBuffer * ub, int64_t value);
bool ucdr_serialize_float(ucdrBuffer * ub, float value);
bool ucdr_serialize_double(ucdrBuffer * ub, double value);

/** Write `size` values one after the other, without their number. `array` may be NULL if `size` is 0. */
bool ucdr_serialize_array_char(ucdrBuffer * ub, const char * array, size_t size);
bool ucdr_serialize_array_bool(ucdrBuffer * ub, const bool * array, size_t size);
bool ucdr_serialize_array_uint8_t(ucdrBuffer * ub, const uint8_t * array, size_t size);
bool ucdr_serialize_array_uint16_t(ucdrBuffer * ub, const uint16_t * array, size_t size);
bool ucdr_serialize_array_uint32_t(ucdrBuffer * ub, const uint32_t * array, size_t size);
bool ucdr_serialize_array_uint64_t(ucdrBuffer * ub, const uint64_t * array, size_t size);
bool ucdr_serialize_array_int8_t(ucdrBuffer * ub, const int8_t * array, size_t size);
bool ucdr_serialize_array_int16_t(ucdrBuffer * ub, const int16_t * array, size_t size);
bool ucdr_serialize_array_int32_t(ucdrBuffer * ub, const int32_t * array, size_t size);
bool ucdr_serialize_array_int64_t(ucdrBuffer * ub, const int64_t * array, size_t size);
bool ucdr_serialize_array_float(ucdrBuffer * ub, const float * array, size_t size);
bool ucdr_serialize_array_double(ucdrBuffer * ub, const double * array, size_t size);

/** Write the number of values, and the values. `array` may be NULL if `size` is 0. */
bool ucdr_serialize_sequence_char(ucdrBuffer * ub, const char * array, uint32_t size);
bool ucdr_serialize_sequence_bool(ucdrBuffer * ub, const bool * array, uint32_t size);
bool ucdr_serialize_sequence_uint8_t(ucdrBuffer * ub, const uint8_t * array, uint32_t size);
bool ucdr_serialize_sequence_uint16_t(ucdrBuffer * ub, const uint16_t * array, uint32_t size);
bool ucdr_serialize_sequence_uint32_t(ucdrBuffer * ub, const uint32_t * array, uint32_t size);
bool ucdr_serialize_sequence_uint64_t(ucdrBuffer * ub, const uint64_t * array, uint32_t size);
bool ucdr_serialize_sequence_int8_t(ucdrBuffer * ub, const int8_t * array, uint32_t size);
bool ucdr_serialize_sequence_int16_t(ucdrBuffer * ub, const int16_t * array, uint32_t size);
bool ucdr_serialize_sequence_int32_t(ucdrBuffer * ub, const int32_t * array, uint32_t size);
bool ucdr_serialize_sequence_int64_t(ucdrBuffer * ub, const int64_t * array, uint32_t size);
bool ucdr_serialize_sequence_float(ucdrBuffer * ub, const float * array, uint32_t size);
bool ucdr_serialize_sequence_double(ucdrBuffer * ub, const double * array, uint32_t size);

/** Writes a string with its NUL and their number. */
bool ucdr_serialize_string(ucdrBuffer * ub, const char * string);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_UCDR_MICROCDR_H */
