/* SPDX-License-Identifier: Apache-2.0 */
/* One slot that is erased and written twice: only one that the application names, because its content is lost. */
#include "selftest_checks.h"
#include "selftest_report.h"

#ifdef SELFTEST_STORAGE_SLOT

#include <string.h>

#include "microros/port_storage.h"

enum { HEAD = 8, BYTES = 24 }; /* multiples of 8; the head is written last, as the library does */

/* Erases the slot, writes the bytes and reads them. Returns whether the port did all of it. */
static bool keep(const uint8_t * bytes, uint8_t * kept)
{
  const uint32_t slot = SELFTEST_STORAGE_SLOT;

  (void)memset(kept, 0, BYTES);
  return port_storage_erase(slot) && port_storage_write(slot, HEAD, &bytes[HEAD], BYTES - HEAD) &&
         port_storage_write(slot, 0, bytes, HEAD) && port_storage_read(slot, 0, kept, BYTES);
}

void selftest_storage(void)
{
  uint8_t bytes[BYTES];
  uint8_t kept[BYTES];

  (void)memset(bytes, 0x55, sizeof(bytes));
  selftest_true(
    "storage_works", keep(bytes, kept), "false of a function", "true of erase, write and read of the slot");
  selftest_true("storage_keeps", memcmp(bytes, kept, sizeof(bytes)) == 0, "other bytes", "those written");
  (void)memset(bytes, 0xAA, sizeof(bytes)); /* each bit that was cleared is set, and the other way round */
  (void)keep(bytes, kept);
  selftest_true(
    "storage_erases", memcmp(bytes, kept, sizeof(bytes)) == 0, "other bytes", "those written after erasing");
}

#else

void selftest_storage(void)
{
  selftest_skip(
    "storage",
    "a slot is erased: name one that is free, -DSELFTEST_STORAGE_SLOT=N, when you compile the self-test");
}

#endif
