/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One slot of the storage: a header of 24 bytes, and records. The header is written last, and has checksums of itself
 * and of the records, so a slot is valid as a whole or not at all. Internal.
 */
#ifndef MICROROS_RCLC_PARAMETER_STORAGE_SLOT_H
#define MICROROS_RCLC_PARAMETER_STORAGE_SLOT_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { STORAGE_VERSION = 1, STORAGE_UNIT = 8 };

/* In the byte order of the processor, which `mark` reveals. */
typedef struct storage_header_t {
  uint32_t mark;
  uint32_t version;
  uint32_t sequence;         /* number of the save; it wraps */
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

/* Returns the CRC-32 (IEEE 802.3) after more bytes; the first `checksum` is 0. */
uint32_t microros_storage_checksum(uint32_t checksum, const uint8_t * bytes, uint32_t size);

/* Reads and checks a whole slot. `room` is a temporary buffer of at least STORAGE_UNIT bytes. */
storage_state_t microros_storage_look(
  uint32_t slot, storage_header_t * header, uint8_t * room, uint32_t room_size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_STORAGE_SLOT_H */
