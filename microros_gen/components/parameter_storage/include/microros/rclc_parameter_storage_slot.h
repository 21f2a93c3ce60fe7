/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One slot of the storage: a header of 24 bytes, and records. The header is written last, and has checksums of itself and of
 * the records, so a slot counts as a whole or not at all. Internal.
 */
#ifndef MICROROS_RCLC_PARAMETER_STORAGE_SLOT_H
#define MICROROS_RCLC_PARAMETER_STORAGE_SLOT_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { STORAGE_VERSION = 1, STORAGE_UNIT = 8 };

/* In the byte order of the processor, which the mark tells apart. */
typedef struct storage_header_t {
  uint32_t mark;
  uint32_t version;
  uint32_t sequence;         /* of the save; goes up, and wraps */
  uint32_t size;             /* bytes of the records */
  uint32_t records_checksum; /* CRC-32 */
  uint32_t checksum;         /* of the members above */
} storage_header_t;

typedef enum storage_state_t {
  STORAGE_EMPTY, /* nothing was ever saved here */
  STORAGE_DAMAGED,
  STORAGE_OTHER_VERSION,
  STORAGE_GOOD
} storage_state_t;

/* Where records go: checksum and size of all, and a slot if they are written. */
typedef struct storage_out_t {
  uint32_t slot;
  uint32_t size;
  uint32_t checksum;
  bool is_written; /* else they are only measured */
  bool failed;
} storage_out_t;

/* CRC-32 (IEEE 802.3) of more bytes; begins with 0. */
uint32_t microros_storage_checksum(uint32_t checksum, const uint8_t * bytes, uint32_t size);

/* Reads and checks a slot as a whole. `room` is for any use meanwhile, of at least STORAGE_UNIT bytes. */
storage_state_t microros_storage_look(
  uint32_t slot, storage_header_t * header, uint8_t * room, uint32_t room_size);

/* Adds bytes; the last unit is filled up with zeros. */
void microros_storage_put(storage_out_t * out, const uint8_t * bytes, uint32_t size);

/* Makes a slot count whose records are written. Returns false if the memory refuses. */
bool microros_storage_commit(const storage_out_t * out, uint32_t sequence);

/* Where the records begin. */
uint32_t microros_storage_first(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_STORAGE_SLOT_H */
