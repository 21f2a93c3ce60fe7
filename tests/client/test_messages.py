# SPDX-License-Identifier: Apache-2.0
"""A library has the functions of rosidl_runtime_c that the members of its messages need, and no others."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder

FOLDER = "src/rosidl_runtime/"
STRINGS = {"string.c"}
WIDE = {*STRINGS, "u16string.c"}


def library(folder: Path, members: str) -> tuple[set[str], set[str]]:
    """Return the sources of rosidl_runtime for a message with `members`, and the names of its sequences of numbers."""
    package = folder / "own_msgs" / "msg"
    package.mkdir(parents=True)
    (package / "Own.msg").write_text(members, encoding="utf-8")
    paths = (folder, shipped_folder())
    options = compiler.Options(
        profiles=("pure_sender",), interfaces=("own_msgs/msg/Own",), interface_paths=paths
    )
    files = compiler.render(compiler.plan(compiler.resolve(compiler.read(options))))
    listed = files["sources.txt"].decode().split("\n")
    source = files.get(f"{FOLDER}primitives_sequence.c", b"").decode()
    numbers = re.findall(r"^PRIMITIVE_SEQUENCE_FUNCTIONS\((\w+), (\w+), ([\w ]+)\)$", source, re.MULTILINE)
    return {name.removeprefix(FOLDER) for name in listed if name.startswith(FOLDER)}, {
        row[0] for row in numbers
    }


@pytest.mark.parametrize(
    ("members", "sources", "numbers"),
    [
        ("int32 a\nuint8[4] b\nstring[2] c", STRINGS, set()),
        ("uint8[<=2] a\nchar[<=2] b", {*STRINGS, "primitives_sequence.c"}, {"uint8"}),
        (
            "float64[<=2] a\nbool[<=2] b",
            {*STRINGS, "primitives_sequence.c"},
            {"double", "float64", "boolean", "bool"},
        ),
        ("string[<=2] a", {*STRINGS, "string_sequence.c"}, set()),
        ("wstring a", WIDE, set()),
        ("wstring[2] a", WIDE, set()),
        ("wstring[<=2] a", {*WIDE, "u16string_sequence.c"}, set()),
        ("sensor_msgs/ChannelFloat32 a", {*STRINGS, "primitives_sequence.c"}, {"float", "float32"}),
    ],
)
def test_only_what_members_need(members: str, sources: set[str], numbers: set[str], tmp_path: Path) -> None:
    assert library(tmp_path, members) == (sources, numbers)
