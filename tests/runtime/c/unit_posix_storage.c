/* SPDX-License-Identifier: Apache-2.0 */
/* Slots that are files: bytes stay over a restart, an erased slot is empty, a missing folder is an error. */
#include "microros/port_storage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 16 };

static const uint8_t bytes[SIZE] = "fifteen letters";

static void expect(bool is_true, const char * what)
{
  if (!is_true) {
    puts(what);
    exit(1);
  }
}

int main(int count, char ** arguments)
{
  const char * const what = count == 2 ? arguments[1] : "";
  uint8_t found[SIZE];

  if (strcmp(what, "write") == 0) {
    expect(!port_storage_read(1, 24, found, SIZE), "nothing is there");
    expect(!port_storage_write(1, 24, bytes, SIZE), "a slot is erased first");
    expect(port_storage_erase(1), "erase");
    expect(port_storage_write(1, 24, bytes, SIZE), "write");
  } else if (strcmp(what, "read") == 0) {
    expect(port_storage_read(1, 24, found, SIZE) && memcmp(found, bytes, SIZE) == 0, "read");
    expect(port_storage_read(1, 0, found, SIZE) && found[0] == 0, "not written");
    expect(!port_storage_read(1, 32, found, SIZE), "the end");
    expect(!port_storage_read(0, 24, found, SIZE), "another slot");
    expect(port_storage_erase(1) && !port_storage_read(1, 24, found, SIZE), "erased");
  } else {
    expect(!port_storage_erase(1) && !port_storage_write(1, 0, bytes, SIZE), "no folder");
  }
  return 0;
}
