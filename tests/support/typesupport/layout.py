# SPDX-License-Identifier: Apache-2.0
"""A C program that prints sizes, offsets and constants of structs."""

from __future__ import annotations

from pathlib import Path

from microros_gen.interfaces.types import Primitive, SequenceType, StringType, element_of
from microros_gen.typesupport.plan.size import members
from microros_gen.typesupport.plan.types import TypePlan
from tests.support.typesupport.build import Generated, run


def facts_program(generated: Generated, plans: list[TypePlan]) -> Path:
    """Write a program that prints what the headers say of each type, be they ours or ROS 2's."""
    lines = ["#include <stddef.h>", "#include <stdio.h>"]
    structs = dict.fromkeys(p.files.struct.removeprefix("include/") for p in plans)
    lines += [f'#include "{struct}"' for struct in structs]
    lines += ["int main(void) {"]
    for plan in plans:
        name = plan.c_name
        lines.append(f'  printf("{name} %zu %zu\\n", sizeof({name}), sizeof({name}__Sequence));')
        for field in members(plan.message):
            place = f"offsetof({name}, {field.name})"
            size = f"sizeof((({name} *)0)->{field.name})"
            lines.append(f'  printf("{name}.{field.name} %zu %zu\\n", {place}, {size});')
            lines += bound_lines(plan, field)
        lines += [constant_line(name, c.name, c.type) for c in plan.message.constants]
    path = generated.folder / "facts.c"
    path.write_text("\n".join([*lines, "  return 0;", "}", ""]))
    return path


def bound_lines(plan: TypePlan, field: object) -> list[str]:
    kind = field.type  # type: ignore[attr-defined]
    symbols = []
    if isinstance(kind, SequenceType) and kind.bound is not None:
        symbols.append("MAX_SIZE")
    element = element_of(kind)
    if isinstance(element, StringType) and element.bound is not None:
        symbols.append("MAX_STRING_SIZE")
    names = [f"{plan.c_name}__{field.name}__{symbol}" for symbol in symbols]  # type: ignore[attr-defined]
    return [f'  printf("{name} %d\\n", (int){name});' for name in names]


def constant_line(name: str, constant: str, kind: Primitive | StringType) -> str:
    symbol = f"{name}__{constant}"
    if isinstance(kind, StringType):
        return f'  printf("{symbol} %s\\n", {symbol});'
    if kind in (Primitive.FLOAT32, Primitive.FLOAT64):
        return f'  printf("{symbol} %.17g\\n", (double){symbol});'
    return f'  printf("{symbol} %lld\\n", (long long){symbol});'


def facts(source: Path, includes: list[str]) -> list[str]:
    output = source.with_suffix("")
    run(["gcc", "-std=c99", "-w", *includes, source, "-o", output])
    return run([output]).splitlines()
