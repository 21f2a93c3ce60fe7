# SPDX-License-Identifier: Apache-2.0
"""What a driver needs of one message type, as a C header: names, storage, a function that gives it any contents."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.interfaces.types import (
    ArrayType,
    FieldType,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
)
from microros_gen.typesupport.plan.types import TypePlan

HEAD = '#ifndef PROOF_TYPES_H\n#define PROOF_TYPES_H\n\n#include "sized.h"\n'


def header(plans: tuple[TypePlan, ...], name: str) -> str:
    """Return types.h for the message `name` (`pkg/msg/Type`)."""
    known = {plan.name: plan for plan in plans}
    plan = next(p for p in plans if str(p.name) == name)
    handle = f"rosidl_typesupport_c__get_message_type_support_handle__{plan.c_name}"
    lines = [HEAD, f'#include "{plan.files.header.removeprefix("include/")}"', "#include <string.h>"]
    bind = f"memset((m), 0, sizeof({plan.c_name}))"
    if plan.storage:
        storage = plan.files.header.removeprefix("include/").rpartition("/")
        lines.append(f'#include "{storage[0]}/detail/{storage[2].removesuffix(".h")}__storage.h"')
        lines.append(f"static {plan.c_name}__Storage proof_storage;")
        bind = f"{plan.c_name}__bind((m), &proof_storage)"
    lines += [
        f"#define PROOF_TYPE {plan.c_name}",
        f"#define PROOF_HANDLE {handle}",
        f"#define PROOF_BIND(m) ((void){bind})",
        f"#define PROOF_MAX {plan.max_encoded_size}",
    ]
    for part in _parts(plan, known):
        lines += _fill(known[part])
    lines += [
        f"static inline void proof_fill({plan.c_name} * m)\n{{\n  fill_{plan.c_name}(m);\n}}",
        "#endif\n",
    ]
    return "\n".join(lines)


def stems(plans: tuple[TypePlan, ...], name: str) -> list[str]:
    """Return what the C files of the message and of those that it has begin with, below the tree."""
    known = {plan.name: plan for plan in plans}
    plan = next(p for p in plans if str(p.name) == name)
    sources = (known[part].files.type_support_source for part in _parts(plan, known))
    return sorted({source.removesuffix("type_support.c") for source in sources})


def _parts(plan: TypePlan, known: dict[TypeName, TypePlan]) -> list[TypeName]:
    """Return the types of `plan`, each after those that it has."""
    found: dict[TypeName, None] = {}
    for field in plan.message.fields:
        kind = field.type.element if isinstance(field.type, (ArrayType, SequenceType)) else field.type
        if isinstance(kind, NamedType):
            found |= dict.fromkeys(_parts(known[kind.name], known))
    return [*found, plan.name]


def _fill(plan: TypePlan) -> Iterator[str]:
    yield f"static inline void fill_{plan.c_name}({plan.c_name} * m)\n{{"
    if not plan.message.fields:
        yield "  proof_any(m, sizeof(*m));"
    for field in plan.message.fields:
        yield from _field(f"m->{field.name}", field.type)
    yield "}"


def _field(member: str, kind: FieldType) -> Iterator[str]:
    if isinstance(kind, ArrayType):
        yield f"  for (size_t i = 0; i < {kind.size}u; ++i) {{"
        yield from (f"  {line}" for line in _field(f"{member}[i]", kind.element))
        yield "  }"
    elif isinstance(kind, SequenceType):
        yield f"  for (size_t i = 0; i < {member}.capacity; ++i) {{"
        yield from (f"  {line}" for line in _field(f"{member}.data[i]", kind.element))
        yield "  }"
        yield f"  PROOF_SIZED({member}, {member}.capacity);"
    elif isinstance(kind, StringType):
        yield f"  proof_any({member}.data, {member}.capacity * sizeof(*{member}.data));"
        yield f"  PROOF_SIZED({member}, {member}.capacity - 1u);"
    elif isinstance(kind, NamedType):
        yield f"  fill_{'__'.join((kind.name.package, kind.name.kind, kind.name.name))}(&{member});"
    elif kind is Primitive.BOOL:
        yield f"  {member} = proof_bool();"
    else:
        yield f"  proof_any(&{member}, sizeof({member}));"
