/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Each record is the body of an rcl_interfaces/srv/SetParameters_Request with one parameter, after its size: saved values
 * pass the checks that values from other nodes pass, and firmware with other parameters reads those that it has.
 */
#include "microros/error.h"
#include "microros/port_storage.h"
#include "microros/rclc_parameter_out.h"
#include "microros/rclc_parameter_storage_slot.h"
#include "microros/rclc_parameter_value.h"
#include "microros/rclc_parameters.h"
#include "rclc_parameter/parameter_storage.h"

#include <stddef.h>
#include <string.h>

/* Output of records: size and checksum of all, and the slot if they are written. */
typedef struct storage_out_t {
  uint32_t slot;
  uint32_t size;
  uint32_t checksum;
  bool is_written; /* otherwise only measured */
  bool failed;
} storage_out_t;

static const uint32_t storage_mark = 0x5053524du;

/* Returns the offset of the first record in a slot. */
static uint32_t storage_first(void)
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
    if (!port_storage_read(slot, storage_first() + done, room, part)) {
      return false;
    }
    checksum = microros_storage_checksum(checksum, room, part);
  }
  return checksum == header->records_checksum;
}

storage_state_t microros_storage_look(
  uint32_t slot, storage_header_t * header, uint8_t * room, uint32_t room_size)
{
  if (!port_storage_read(slot, 0u, (uint8_t *)header, storage_first()) || storage_is_erased(header)) {
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
  if (out->is_written && !port_storage_write(out->slot, storage_first() + out->size, bytes, size)) {
    out->failed = true;
  }
  out->checksum = microros_storage_checksum(out->checksum, bytes, size);
  out->size += size;
}

/* Adds bytes; the last unit is padded with zeros. */
static void storage_put(storage_out_t * out, const uint8_t * bytes, uint32_t size)
{
  const uint32_t rest = size % (uint32_t)STORAGE_UNIT;

  storage_put_units(out, bytes, size - rest);
  if (rest != 0u) {
    uint8_t last[STORAGE_UNIT] = {0};

    (void)memcpy(last, &bytes[size - rest], rest);
    storage_put_units(out, last, (uint32_t)STORAGE_UNIT);
  }
}

/* Makes a slot valid, after its records were written. Returns false if the memory refuses. */
static bool storage_commit(const storage_out_t * out, uint32_t sequence)
{
  storage_header_t header = {storage_mark, STORAGE_VERSION, sequence, out->size, out->checksum, 0};

  header.checksum = storage_own_checksum(&header);
  return !out->failed && port_storage_write(out->slot, 0u, (const uint8_t *)&header, storage_first());
}

enum { STORAGE_SLOTS = 2 };

/* The two slots of a server: the newest valid one, and the state of the other one. */
typedef struct storage_found_t {
  uint32_t newest; /* slot; the first one if none is valid */
  storage_state_t newest_state;
  storage_state_t other_state;
  storage_header_t header; /* of the newest */
} storage_found_t;

static rcl_ret_t storage_refuse(const char * why)
{
  return microros_error_named(RCL_RET_ERROR, microros_error_storage, why);
}

static rcl_ret_t storage_check_call(const rclc_parameter_server_t * server)
{
  if (server == NULL || server->node == NULL) {
    return rclc_parameter_refuse_argument();
  }
  return server->on_callback ? RCLC_PARAMETER_DISABLED_ON_CALLBACK : RCL_RET_OK;
}

/* If both slots are valid, the one with the later number counts, even after the number has wrapped. */
static storage_found_t storage_find(rclc_parameter_server_t * server, uint32_t set)
{
  const uint32_t first = set * (uint32_t)STORAGE_SLOTS;
  storage_header_t second;
  storage_found_t found = {.newest = first};

  found.newest_state =
    microros_storage_look(first, &found.header, server->request, MICROROS_PARAMETER_REQUEST_SIZE);
  found.other_state =
    microros_storage_look(first + 1u, &second, server->request, MICROROS_PARAMETER_REQUEST_SIZE);
  if (
    found.other_state > found.newest_state ||
    (found.other_state == STORAGE_GOOD && second.sequence - found.header.sequence < 0x80000000u)) {
    const storage_state_t state = found.newest_state;

    found.newest = first + 1u;
    found.newest_state = found.other_state;
    found.other_state = state;
    found.header = second;
  }
  return found;
}

/* Returns whether the stored request has exactly one parameter. */
static bool storage_is_parameter(const rclc_parameter_server_t * server)
{
  cdr_in_t in = rclc_parameter_request_begin(server);
  const uint32_t count = rclc_parameter_in_length(&in);
  parameter_requested_t requested;

  if (count == 1u) {
    rclc_parameter_request_parameter(&in, &requested);
  }
  return count == 1u && !in.failed;
}

/* Sets the value of a record. Returns whether it was accepted. */
static bool storage_apply(rclc_parameter_server_t * server, uint32_t slot, uint32_t offset, uint32_t size)
{
  const uint32_t whole = size - size % (uint32_t)STORAGE_UNIT;

  if (size > (uint32_t)sizeof(server->request) || !port_storage_read(slot, offset, server->request, whole)) {
    return false;
  }
  if (size != whole) {
    uint8_t last[STORAGE_UNIT];

    if (!port_storage_read(slot, offset + whole, last, (uint32_t)STORAGE_UNIT)) {
      return false;
    }
    (void)memcpy(&server->request[whole], last, size - whole);
  }
  server->request_size = size;
  server->request_swaps = false;
  if (!storage_is_parameter(server)) {
    return false;
  }
  rclc_parameter_set_each(server);
  return server->outcomes[0] == (uint8_t)PARAMETER_SET;
}

static uint32_t storage_aligned(uint32_t size)
{
  return (size + (uint32_t)STORAGE_UNIT - 1u) / (uint32_t)STORAGE_UNIT * (uint32_t)STORAGE_UNIT;
}

/* Returns how many records were not accepted. A malformed record ends the slot. */
static size_t storage_apply_all(rclc_parameter_server_t * server, const storage_found_t * found)
{
  uint32_t done = 0;
  size_t skipped = 0;

  while (done + (uint32_t)STORAGE_UNIT <= found->header.size) {
    const uint32_t at = storage_first() + done;
    uint32_t prefix[STORAGE_UNIT / sizeof(uint32_t)];

    done += (uint32_t)STORAGE_UNIT;
    if (
      !port_storage_read(found->newest, at, (uint8_t *)prefix, (uint32_t)STORAGE_UNIT) ||
      prefix[0] > found->header.size - done) {
      return skipped + 1u;
    }
    if (!storage_apply(server, found->newest, at + (uint32_t)STORAGE_UNIT, prefix[0])) {
      ++skipped;
    }
    done += storage_aligned(prefix[0]);
  }
  return skipped;
}

rcl_ret_t rclc_parameter_storage_load(
  rclc_parameter_server_t * parameter_server, uint32_t set, size_t * skipped)
{
  rcl_ret_t result = storage_check_call(parameter_server);
  storage_found_t found;
  size_t count = 0;

  if (result != RCL_RET_OK) {
    return result;
  }
#if MICROROS_PARAMETERS_HELD
  if (parameter_server->held.has_begun) {
    return storage_refuse(MICROROS_ERROR_WORDS(
      "load before rclc_executor_add_parameter_server: later values overrule the held ones"));
  }
#endif
  found = storage_find(parameter_server, set);
  if (found.newest_state == STORAGE_GOOD) {
    count = storage_apply_all(parameter_server, &found);
  } else if (found.newest_state == STORAGE_OTHER_VERSION) {
    result = storage_refuse(MICROROS_ERROR_WORDS("the values are of another version of the format"));
  } else if (found.newest_state == STORAGE_DAMAGED) {
    result = storage_refuse(MICROROS_ERROR_WORDS("the values are damaged"));
  } else {
    /* nothing was ever saved */
  }
  if (skipped != NULL) {
    *skipped = count;
  }
  return result;
}

/* Adds all values that other nodes may set. */
static void storage_put_all(rclc_parameter_server_t * server, storage_out_t * out)
{
  for (size_t i = 0; i < server->count; ++i) {
    const rclc_parameter_place_t * const place = &server->places[i];
    parameter_out_t body = {server->request, 0, MICROROS_PARAMETER_REQUEST_SIZE, false};
    uint32_t prefix[STORAGE_UNIT / sizeof(uint32_t)] = {0};

    if (place->read_only || place->event == (uint8_t)PARAMETER_EVENT_DELETED) {
      continue;
    }
    rclc_parameter_out_4(&body, 1u);
    rclc_parameter_out_text(&body, place->about->name);
    rclc_parameter_out_value(&body, place);
    prefix[0] = body.position;
    storage_put(out, (const uint8_t *)prefix, (uint32_t)STORAGE_UNIT);
    storage_put(out, server->request, body.position);
    out->failed = out->failed || body.full;
  }
}

rcl_ret_t rclc_parameter_storage_save(rclc_parameter_server_t * parameter_server, uint32_t set)
{
  const rcl_ret_t result = storage_check_call(parameter_server);
  storage_out_t measured = {0};
  storage_out_t written = {.is_written = true};
  storage_header_t header;
  storage_found_t found;
  bool is_good;

  if (result != RCL_RET_OK) {
    return result;
  }
  found = storage_find(parameter_server, set);
  storage_put_all(parameter_server, &measured);
  is_good = found.newest_state == STORAGE_GOOD;
  if (
    is_good && !measured.failed && measured.size == found.header.size &&
    measured.checksum == found.header.records_checksum) {
    return RCL_RET_OK; /* unchanged: spares the memory a write */
  }
  /* Never the slot that counts. Without one, the first slot, unless it has values of other firmware. */
  written.slot = found.newest_state >= STORAGE_OTHER_VERSION ? (found.newest ^ 1u) : found.newest;
  if (measured.failed || !port_storage_erase(written.slot)) {
    return storage_refuse(MICROROS_ERROR_WORDS("the memory cannot be erased"));
  }
  storage_put_all(parameter_server, &written);
  if (!storage_commit(&written, is_good ? found.header.sequence + 1u : 0u)) {
    return storage_refuse(MICROROS_ERROR_WORDS("the memory cannot be written"));
  }
  if (
    microros_storage_look(
      written.slot, &header, parameter_server->request, MICROROS_PARAMETER_REQUEST_SIZE) != STORAGE_GOOD) {
    return storage_refuse(MICROROS_ERROR_WORDS("the memory reads other bytes than were written"));
  }
  return RCL_RET_OK;
}
