/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/ucdr_put.h"

#include <string.h>

static ucdrEndianness buffer_machine(void)
{
  const uint16_t number = 1u;

  return *(const uint8_t *)&number != 0u ? UCDR_LITTLE_ENDIANNESS : UCDR_BIG_ENDIANNESS;
}

void ucdr_init_buffer(ucdrBuffer * ub, uint8_t * data, size_t size)
{
  ucdr_init_buffer_origin_offset_endian(ub, data, size, 0u, 0u, buffer_machine());
}

void ucdr_init_buffer_origin(ucdrBuffer * ub, uint8_t * data, size_t size, size_t origin)
{
  ucdr_init_buffer_origin_offset_endian(ub, data, size, origin, 0u, buffer_machine());
}

void ucdr_init_buffer_origin_offset(
  ucdrBuffer * ub, uint8_t * data, size_t size, size_t origin, size_t offset)
{
  ucdr_init_buffer_origin_offset_endian(ub, data, size, origin, offset, buffer_machine());
}

void ucdr_init_buffer_origin_offset_endian(
  ucdrBuffer * ub, uint8_t * data, size_t size, size_t origin, size_t offset, ucdrEndianness endianness)
{
  ub->init = data;
  ub->final = &data[size];
  ub->origin = origin;
  ub->endianness = endianness;
  ub->on_full_buffer = NULL;
  ub->args = NULL;
  ucdr_reset_buffer_offset(ub, offset);
}

void ucdr_copy_buffer(ucdrBuffer * ub_dest, const ucdrBuffer * ub_source)
{
  *ub_dest = *ub_source;
}

void ucdr_set_on_full_buffer_callback(ucdrBuffer * ub, OnFullBuffer on_full_buffer, void * args)
{
  ub->on_full_buffer = on_full_buffer;
  ub->args = args;
}

void ucdr_reset_buffer(ucdrBuffer * ub)
{
  ucdr_reset_buffer_offset(ub, 0u);
}

void ucdr_reset_buffer_offset(ucdrBuffer * ub, size_t offset)
{
  ub->iterator = &ub->init[offset];
  ub->offset = ub->origin + offset;
  ub->last_data_size = 0;
  ub->error = false;
}

size_t ucdr_alignment(size_t buffer_position, size_t data_size)
{
  return (data_size - buffer_position % data_size) % data_size;
}

size_t ucdr_buffer_alignment(const ucdrBuffer * ub, size_t data_size)
{
  return ucdr_alignment(ub->offset, data_size);
}

void ucdr_advance_buffer(ucdrBuffer * ub, size_t size)
{
  if (ub->error || size > ucdr_buffer_remaining(ub)) {
    ub->error = true;
    return;
  }
  ub->iterator = &ub->iterator[size];
  ub->offset += size;
}

size_t ucdr_buffer_size(const ucdrBuffer * ub)
{
  return (size_t)(ub->final - ub->init);
}

size_t ucdr_buffer_length(const ucdrBuffer * ub)
{
  return (size_t)(ub->iterator - ub->init);
}

size_t ucdr_buffer_remaining(const ucdrBuffer * ub)
{
  return (size_t)(ub->final - ub->iterator);
}

ucdrEndianness ucdr_buffer_endianness(const ucdrBuffer * ub)
{
  return ub->endianness;
}

bool ucdr_buffer_has_error(const ucdrBuffer * ub)
{
  return ub->error;
}

/* Writes bytes; makes room as often as necessary. */
static void buffer_put(ucdrBuffer * ub, const uint8_t * bytes, size_t size)
{
  size_t done = 0;

  while (done < size && !ub->error) {
    const size_t room = ucdr_buffer_remaining(ub);
    const size_t part = size - done < room ? size - done : room;

    if (room == 0u) {
      ub->error =
        ub->on_full_buffer == NULL || ub->on_full_buffer(ub, ub->args) || ucdr_buffer_remaining(ub) == 0u;
    } else {
      (void)memcpy(ub->iterator, &bytes[done], part);
      ucdr_advance_buffer(ub, part);
      done += part;
    }
  }
}

static void buffer_pad(ucdrBuffer * ub, size_t alignment)
{
  static const uint8_t zeros[8] = {0};

  buffer_put(ub, zeros, ucdr_buffer_alignment(ub, alignment));
}

/* Without a callback nothing of what does not fit is written. */
static bool buffer_has_room(ucdrBuffer * ub, size_t size, size_t count)
{
  if (ub->on_full_buffer == NULL && !ub->error) {
    const size_t padding = ucdr_buffer_alignment(ub, size);
    const size_t room = ucdr_buffer_remaining(ub);

    ub->error = padding > room || count > (room - padding) / size;
  }
  return !ub->error;
}

void ucdr_align_to(ucdrBuffer * ub, size_t alignment)
{
  if (buffer_has_room(ub, alignment, 0u)) {
    buffer_pad(ub, alignment);
  }
  ub->last_data_size = (uint8_t)alignment;
}

/* Writes values whose bytes are the other way round than in memory. */
static void buffer_put_swapped(ucdrBuffer * ub, const uint8_t * values, size_t size, size_t count)
{
  uint8_t swapped[8];

  for (size_t i = 0; i < count && !ub->error; ++i) {
    for (size_t k = 0; k < size; ++k) {
      swapped[k] = values[i * size + (size - 1u - k)];
    }
    buffer_put(ub, swapped, size);
  }
}

bool ucdr_put(ucdrBuffer * ub, const void * values, size_t size, size_t count)
{
  if (count == 0u || !buffer_has_room(ub, size, count)) {
    return !ub->error;
  }
  buffer_pad(ub, size);
  if (size == 1u || ub->endianness == buffer_machine()) {
    buffer_put(ub, values, size * count);
  } else {
    buffer_put_swapped(ub, values, size, count);
  }
  ub->last_data_size = (uint8_t)size;
  return !ub->error;
}
