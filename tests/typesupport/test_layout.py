# SPDX-License-Identifier: Apache-2.0
"""Structs, constants and bounds against the C headers in the wheels, and against the planned layout."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from ts_build import Generated, run

from microros_gen.interfaces.types import Primitive, SequenceType, StringType, element_of
from microros_gen.typesupport.plan.layout import LP64, StructLayouts
from microros_gen.typesupport.plan.size import members
from microros_gen.typesupport.plan.types import TypePlan

pytestmark = pytest.mark.ros

PREFIX = Path(sys.prefix)


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


def test_structs_and_constants_are_those_of_rosidl(everything: Generated) -> None:
    plans = [p for p in everything.plans if (PREFIX / "include" / p.name.package).is_dir()]
    assert len(plans) == 273
    source = facts_program(everything, plans)
    own = facts(source, everything.includes)
    theirs = facts(source, [f"-I{folder}" for folder in sorted((PREFIX / "include").iterdir())])
    assert own == theirs
    assert len(own) > 1500


def test_planned_layout_is_the_compilers(everything: Generated) -> None:
    layouts = StructLayouts(everything.messages, LP64)
    expected = []
    for plan in everything.plans:
        expected.append((plan.c_name, str(layouts.extent(plan.name).size)))
        offsets = layouts.offsets(plan.name).items()
        expected += [(f"{plan.c_name}.{member}", str(offset)) for member, offset in offsets]
    source = facts_program(everything, list(everything.plans))
    found = {tuple(line.split(" ")[:2]) for line in facts(source, everything.includes)}
    assert set(expected) <= found


@pytest.mark.parametrize("ending", ["__type_support.c", "__storage.c"])
def test_a_wrong_size_does_not_compile(everything: Generated, ending: str, tmp_path: Path) -> None:
    """The sizes in the plan are asserted in the code, for each data model."""
    (source,) = everything.sources(f"sensor_msgs/joint_state{ending}")
    text = source.read_text()
    (sizes,) = re.findall(r"CDR_SIZE\((\d+)U, (\d+)U, (\d+)U\)", text)
    for option, size in (("-m64", sizes[0]), ("-m32", sizes[2])):
        command = ["gcc", option, "-std=c99", "-fsyntax-only", *everything.includes]
        run([*command, source])
        wrong = tmp_path / "wrong.c"
        wrong.write_text(text.replace(f"{size}U", f"{int(size) + 1}U", 3))
        result = subprocess.run([*command, str(wrong)], capture_output=True, text=True, check=False)
        assert "sensor_msgs__msg__JointState__assert" in result.stderr
