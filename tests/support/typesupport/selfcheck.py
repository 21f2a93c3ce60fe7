# SPDX-License-Identifier: Apache-2.0
"""A C program that binds, fills and encodes every root, and prints a hash of the bytes.

It is the same for every compiler and target, so two builds of it must print the same.
"""

from __future__ import annotations

from pathlib import Path

from microros_gen.interfaces.types import (
    ArrayType,
    Field,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    element_of,
)
from microros_gen.typesupport.plan.size import members
from microros_gen.typesupport.plan.types import TypePlan
from tests.support.typesupport.build import Generated

PRELUDE = """
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "microros/message_type.h"
static uint32_t state;
static int full;
static uint32_t next_number(void) { state = state * 1664525u + 1013904223u; return state >> 8u; }
static size_t next_size(size_t capacity) { return full ? capacity : next_number() % (capacity + 1u); }
static void fill_string(rosidl_runtime_c__String * text) {
  text->size = next_size(text->capacity - 1u);
  for (size_t i = 0; i < text->size; ++i) { text->data[i] = (char)(33u + next_number() % 90u); }
  text->data[text->size] = 0;
}
static void fill_wstring(rosidl_runtime_c__U16String * text) {
  text->size = next_size(text->capacity - 1u);
  for (size_t i = 0; i < text->size; ++i) { text->data[i] = (uint_least16_t)(next_number() % 60000u); }
  text->data[text->size] = 0;
}
static void check(const char * name, const rosidl_message_type_support_t * handle, const void * message) {
  const microros_message_type_t * const type = (const microros_message_type_t *)handle->data;
  cdr_fault_t fault = {.field = ""};
  const uint32_t size = type->encoded_size(message, &fault);
  uint8_t * const body = (uint8_t *)malloc(size ? size : 1u);
  const uint32_t written = size ? type->encode(message, body, &fault) : 0u;
  uint32_t hash = 2166136261u;
  for (uint32_t i = 0; i < written; ++i) { hash = (hash ^ body[i]) * 16777619u; }
  const int wrong = size == 0u || written != size || (full && size != type->max_encoded_size);
  printf("%s %u %08x %s%s\\n", name, (unsigned)size, (unsigned)hash, fault.field, wrong ? " WRONG" : "");
  free(body);
}
"""


def write_selfcheck(generated: Generated) -> Path:
    """Write the program; it stands alone but for the generated sources."""
    roots = [plan for plan in generated.plans if plan.root]
    lines = [f'#include "{plan.files.header.removeprefix("include/")}"' for plan in roots]
    lines += ['#include "rosidl_runtime_c/string.h"', '#include "rosidl_runtime_c/u16string.h"', PRELUDE]
    for plan in generated.plans:
        lines += _filler(plan)
    for plan in roots:
        lines += _run(plan)
    lines += ["int main(void) {", "  for (full = 0; full < 2; ++full) {"]
    lines += [f"    run_{plan.c_name}();" for plan in roots]
    path = generated.folder / "selfcheck.c"
    path.write_text("\n".join([*lines, "  }", "  return 0;", "}", ""]))
    return path


def _filler(plan: TypePlan) -> list[str]:
    lines = [f"static void fill_{plan.c_name}({plan.c_name} * m) {{"]
    for field in members(plan.message):
        lines += _fill_field(field)
    return [*lines, "}"]


def _fill_field(field: Field) -> list[str]:
    member = f"m->{field.name}"
    if isinstance(field.type, SequenceType):
        each = _fill_element(f"{member}.data[i]", element_of(field.type))
        loop = f"  for (size_t i = 0; i < {member}.size; ++i) {{ {each} }}"
        return [f"  {member}.size = next_size({member}.capacity);", loop]
    if isinstance(field.type, ArrayType):
        each = _fill_element(f"{member}[i]", field.type.element)
        return [f"  for (size_t i = 0; i < {field.type.size}u; ++i) {{ {each} }}"]
    return [f"  {_fill_element(member, field.type)}"]


def _fill_element(place: str, element: Primitive | StringType | NamedType) -> str:
    if isinstance(element, NamedType):
        name = f"{element.name.package}__{element.name.kind}__{element.name.name}"
        return f"fill_{name}(&{place});"
    if isinstance(element, StringType):
        return f"fill_{'w' if element.wide else ''}string(&{place});"
    if element is Primitive.BOOL:
        return f"{place} = (next_number() & 1u) != 0u;"
    return f"{place} = ({element.c_type})next_number();"


def _run(plan: TypePlan) -> list[str]:
    name = plan.c_name
    handle = f"ROSIDL_GET_MSG_TYPE_SUPPORT({plan.name.package}, {plan.name.kind}, {plan.name.name})"
    lines = [f"static void run_{name}(void) {{", f"  {name} * const m = ({name} *)malloc(sizeof(*m));"]
    if plan.storage:
        lines.append(f"  {name}__Storage * const s = ({name}__Storage *)malloc(sizeof(*s));")
        lines.append("  memset(s, 0xA5, sizeof(*s));")
        lines.append(f"  {name}__bind(m, s);")
    else:
        lines.append("  memset(m, 0, sizeof(*m));")
    lines += ["  state = 1u;", f"  fill_{name}(m);", f'  check("{plan.name}", {handle}, m);', "  free(m);"]
    return [*lines, "  free(s);" if plan.storage else "", "}"]
