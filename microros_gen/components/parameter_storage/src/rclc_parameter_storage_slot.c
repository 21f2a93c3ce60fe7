/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_storage_slot.h"

#include "microros/port_storage.h"

#include <stddef.h>
#include <string.h>

static const uint32_t storage_mark = 0x5053524du;

uint32_t microros_storage_first(void)
{
  return (uint32_t)sizeof(storage_header_t);
}

uint32_t microros_storage_checksum(uint32_t checksum, const uint8_t * bytes, uint32_t size)
{
  uint32_t next = ~checksum;

  for (uint32_t i = 0; i < size; ++i) {
    next ^= bytes[i];
    for (uint32_t bit = 0; bit < 8u; ++bit) {
      next = (next & 1u) != 0u ? (next >> 1) ^ 0xedb88320u : next >> 1;
    }
  }
  return ~next;
}

static uint32_t storage_own_checksum(const storage_header_t * header)
{
  return microros_storage_checksum(
    0u, (const uint8_t *)header, (uint32_t)offsetof(storage_header_t, checksum));
}

/* Memory that is erased, or was never written: all bytes are the same. */
static bool storage_is_erased(const storage_header_t * header)
{
  const uint8_t * const bytes = (const uint8_t *)header;

  for (size_t i = 1; i < sizeof(*header); ++i) {
    if (bytes[i] != bytes[0]) {
      return false;
    }
  }
  return true;
}

static bool storage_records_are_good(
  uint32_t slot, const storage_header_t * header, uint8_t * room, uint32_t room_size)
{
  const uint32_t most = room_size - room_size % (uint32_t)STORAGE_UNIT;
  uint32_t checksum = 0;
  uint32_t part;

  for (uint32_t done = 0; done < header->size; done += part) {
    part = header->size - done < most ? header->size - done : most;
    if (!port_storage_read(slot, microros_storage_first() + done, room, part)) {
      return false;
    }
    checksum = microros_storage_checksum(checksum, room, part);
  }
  return checksum == header->records_checksum;
}

storage_state_t microros_storage_look(
  uint32_t slot, storage_header_t * header, uint8_t * room, uint32_t room_size)
{
  if (
    !port_storage_read(slot, 0u, (uint8_t *)header, microros_storage_first()) || storage_is_erased(header)) {
    return STORAGE_EMPTY;
  }
  if (header->mark != storage_mark || header->checksum != storage_own_checksum(header)) {
    return STORAGE_DAMAGED;
  }
  if (header->version != (uint32_t)STORAGE_VERSION) {
    return STORAGE_OTHER_VERSION;
  }
  return storage_records_are_good(slot, header, room, room_size) ? STORAGE_GOOD : STORAGE_DAMAGED;
}

static void storage_put_units(storage_out_t * out, const uint8_t * bytes, uint32_t size)
{
  if (size == 0u || out->failed) {
    return;
  }
  if (out->is_written && !port_storage_write(out->slot, microros_storage_first() + out->size, bytes, size)) {
    out->failed = true;
  }
  out->checksum = microros_storage_checksum(out->checksum, bytes, size);
  out->size += size;
}

void microros_storage_put(storage_out_t * out, const uint8_t * bytes, uint32_t size)
{
  const uint32_t rest = size % (uint32_t)STORAGE_UNIT;

  storage_put_units(out, bytes, size - rest);
  if (rest != 0u) {
    uint8_t last[STORAGE_UNIT] = {0};

    (void)memcpy(last, &bytes[size - rest], rest);
    storage_put_units(out, last, (uint32_t)STORAGE_UNIT);
  }
}

bool microros_storage_commit(const storage_out_t * out, uint32_t sequence)
{
  storage_header_t header = {storage_mark, STORAGE_VERSION, sequence, out->size, out->checksum, 0};

  header.checksum = storage_own_checksum(&header);
  return !out->failed &&
         port_storage_write(out->slot, 0u, (const uint8_t *)&header, microros_storage_first());
}
