# SPDX-License-Identifier: Apache-2.0
"""Structs, constants and bounds against the C headers in the wheels, and against the planned layout."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from microros_gen.typesupport.plan.layout import LP64, StructLayouts
from tests.support.typesupport.build import Generated, run
from tests.support.typesupport.layout import facts, facts_program

pytestmark = [pytest.mark.ros, pytest.mark.builds]

PREFIX = Path(sys.prefix)


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
