/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Memory that keeps its content without power, in slots: pages of flash, an EEPROM, files. A slot is erased as a
 * whole, then written once at each offset: first the records, and the header at offset 0 last. Offsets and sizes are
 * multiples of 8 bytes. Called in the task that loads and saves.
 */
#ifndef MICROROS_PORT_STORAGE_H
#define MICROROS_PORT_STORAGE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Erases a slot; its content is undefined until it is written. Returns false if that fails. */
bool port_storage_erase(uint32_t slot);

/* Writes `size` bytes and waits until they are stored. Returns false if that fails or they exceed the slot. */
bool port_storage_write(uint32_t slot, uint32_t offset, const uint8_t * bytes, uint32_t size);

/* Reads `size` bytes, whether or not they have been written. Returns false if the slot does not exist or is too short. */
bool port_storage_read(uint32_t slot, uint32_t offset, uint8_t * bytes, uint32_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_STORAGE_H */
