# SPDX-License-Identifier: Apache-2.0
"""C programs over all types: one replays bodies from a file on any target, one is a target of libFuzzer.

The file holds bodies in both byte orders, with the little endian one that the same contents encode to. A target
decodes a body, checks that it encodes to that, and says where it does not.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path

from microros_gen.typesupport.plan.types import TypePlan
from tests.support.typesupport import cdr
from tests.support.typesupport.build import Generated
from tests.support.typesupport.values import Randomizer

COMMON = """
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "microros/cdr_decode.h"
#include "microros/message_memory.h"
typedef struct test_type_t {
  const char * name;
  const rosidl_message_type_support_t * (*handle)(void);
  void (*bind)(void * message, void * storage);
  size_t message_size;
  size_t storage_size;
} test_type_t;
/* nothing here may need memory */
void * microros_memory_take(const microros_pool_t * pool, size_t * size) { (void)pool; (void)size; abort(); }
size_t microros_memory_room(const microros_pool_t * pool, const void * memory) { (void)pool; (void)memory; abort(); }
void microros_memory_give_back(const microros_pool_t * pool, void * memory) { (void)pool; (void)memory; abort(); }
static void * test_block(size_t size) {
  void * const block = malloc(size ? size : 1u);
  if (block == NULL) { abort(); }
  memset(block, 0xA5, size);
  return block;
}
"""

REPLAY = """
static uint32_t next_number(FILE * file) {
  uint8_t b[4];
  if (fread(b, 1, 4, file) != 4) { exit(3); }
  return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}
static uint8_t * next_body(FILE * file, uint32_t * size) {
  *size = next_number(file);
  uint8_t * const body = test_block(*size);
  if (fread(body, 1, *size, file) != *size) { exit(3); }
  return body;
}
static int replay(const test_type_t * t, const uint8_t * body, uint32_t size, bool big,
                  const uint8_t * expected, uint32_t length) {
  const uint16_t one = 1;
  const bool swap = big == (*(const uint8_t *)&one == 1);
  const microros_message_type_t * const type = t->handle()->data;
  cdr_fault_t fault = {.field = ""};
  void * const message = test_block(t->message_size);
  void * const storage = test_block(t->storage_size);
  t->bind(message, storage);
  int wrong = !cdr_decode(type, body, size, swap, message, &fault);
  if (!wrong) {
    const uint32_t written = type->encoded_size(message, &fault);
    uint8_t * const again = test_block(written);
    wrong = written != length || type->encode(message, again, &fault) != length ||
      memcmp(again, expected, length) != 0;
    free(again);
  }
  if (wrong) { printf("WRONG %s %s %s\\n", t->name, big ? "big" : "little", fault.field); }
  for (uint32_t cut = 0; cut < size && size < 200u; ++cut) {
    uint8_t * const part = test_block(cut);
    memcpy(part, body, cut);
    if (cdr_decode(type, part, cut, swap, message, &fault)) { printf("WRONG %s cut %u\\n", t->name, (unsigned)cut); }
    free(part);
  }
  free(message);
  free(storage);
  return wrong;
}
int main(int argc, char ** argv) {
  FILE * const file = fopen(argv[argc - 1], "rb");
  if (file == NULL) { return 2; }
  const uint32_t count = next_number(file);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t index = next_number(file);
    const uint32_t big = next_number(file);
    uint32_t size;
    uint32_t length;
    uint8_t * const body = next_body(file, &size);
    uint8_t * const expected = next_body(file, &length);
    replay(&test_types[index], body, size, big != 0u, expected, length);
    free(body);
    free(expected);
  }
  printf("%u bodies\\n", (unsigned)count);
  fclose(file);
  return 0;
}
"""

FUZZ = """
#include "rcutils/allocator.h"
/* Of functions that nothing here calls; the fuzzer's counters keep them in the program. */
rcutils_allocator_t rcutils_get_default_allocator(void) { abort(); }
int LLVMFuzzerTestOneInput(const uint8_t * data, size_t size);
/* Byte 0 and 1: the type; bit 7 of byte 1: the byte order. What is read must encode, and mean the same again. */
int LLVMFuzzerTestOneInput(const uint8_t * data, size_t size) {
  if (size < 2u) { return 0; }
  const test_type_t * const t =
    &test_types[((data[1] & 0x7Fu) << 8u | data[0]) % (sizeof(test_types) / sizeof(*test_types))];
  const microros_message_type_t * const type = t->handle()->data;
  cdr_fault_t fault = {.field = NULL};
  void * const message = test_block(t->message_size);
  void * const storage = test_block(t->storage_size);
  const uint32_t length = (uint32_t)size - 2u;
  uint8_t * const body = test_block(length);
  memcpy(body, &data[2], length);
  t->bind(message, storage);
  if (cdr_decode(type, body, length, (data[1] & 0x80u) != 0u, message, &fault)) {
    if (fault.field != NULL) { abort(); }
    const uint32_t written = type->encoded_size(message, &fault);
    if (written == 0u || written > type->max_encoded_size) { abort(); }
    uint8_t * const first = test_block(written);
    uint8_t * const second = test_block(written);
    if (type->encode(message, first, &fault) != written) { abort(); }
    t->bind(message, storage);
    if (!cdr_decode(type, first, written, false, message, &fault)) { abort(); }
    if (type->encode(message, second, &fault) != written || memcmp(first, second, written) != 0) { abort(); }
    free(first);
    free(second);
  } else {
    if (fault.field == NULL || fault.found <= fault.fits) { abort(); }
    (void)type->encoded_size(message, &fault); /* what was read in part may be looked at */
  }
  free(body);
  free(message);
  free(storage);
  return 0;
}
"""


def roots(generated: Generated) -> list[TypePlan]:
    """Return the types that have a handle, in the order of their numbers."""
    return [plan for plan in generated.plans if plan.root]


def write_program(generated: Generated, name: str, rest: str) -> Path:
    """Write a program (REPLAY or FUZZ) with the table of all types; it stands alone but for the generated code."""
    plans = roots(generated)
    headers = sorted({plan.files.header for plan in plans})
    lines = [f'#include "{header.removeprefix("include/")}"' for header in headers]
    lines.append(COMMON)
    for plan in plans:
        bind = (
            f"{plan.c_name}__bind(m, s)" if plan.storage else f"(void)s; memset(m, 0, sizeof({plan.c_name}))"
        )
        lines.append(f"static void bind_{plan.c_name}(void * m, void * s) {{ {bind}; }}")
    lines.append("static const test_type_t test_types[] = {")
    for plan in plans:
        handle = f"rosidl_typesupport_c__get_message_type_support_handle__{plan.c_name}"
        storage = f"sizeof({plan.c_name}__Storage)" if plan.storage else "0"
        lines.append(f'  {{"{plan.name}", {handle}, bind_{plan.c_name}, sizeof({plan.c_name}), {storage}}},')
    path = generated.folder / name
    path.write_text("\n".join([*lines, "};", rest]))
    return path


def bodies(
    generated: Generated, seed: int, modes: tuple[str, ...]
) -> Iterator[tuple[int, int, bytes, bytes]]:
    """Yield number of the type, byte order, body and little endian body."""
    for index, plan in enumerate(roots(generated)):
        source = Randomizer(generated.messages, seed + index)
        for mode in modes:
            tree = source.tree(plan.name, plan.limits, mode)
            little, big = (cdr.encode(generated.messages, plan.name, tree, b) for b in (False, True))
            yield index, 0, little, little
            yield index, 1, big, little


def write_bodies(generated: Generated, path: Path, modes: tuple[str, ...]) -> int:
    """Write the file that REPLAY reads; return how many bodies it has."""
    found = list(bodies(generated, 500, modes))
    parts = [struct.pack("<I", len(found))]
    for index, big, body, little in found:
        parts.append(struct.pack("<III", index, big, len(body)) + body)
        parts.append(struct.pack("<I", len(little)) + little)
    path.write_bytes(b"".join(parts))
    return len(found)


def write_seeds(generated: Generated, folder: Path) -> None:
    """Write a body of each type and byte order as libFuzzer's first corpus."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, (index, big, body, _) in enumerate(bodies(generated, 900, ("random",))):
        (folder / str(number)).write_bytes(bytes([index & 0xFF, index >> 8 | big << 7]) + body)
