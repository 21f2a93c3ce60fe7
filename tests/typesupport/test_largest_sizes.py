# SPDX-License-Identifier: Apache-2.0
"""`…__MAX_ENCODED_SIZE` is asserted in C: a wrong number does not compile, and the text stays short.

That every type compiles, on all targets, is in test_compilers.py; that full messages have that size in test_bytes.py.
"""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.application.model import LimitRule
from microros_gen.interfaces.find import shipped_folder
from tests.support.typesupport.build import COMPONENTS, WARNINGS, Generated, generate, run

pytestmark = pytest.mark.builds

TYPES = (
    "std_msgs/msg/Int32",
    "sensor_msgs/msg/JointState",
    "visualization_msgs/msg/MarkerArray",
    "geometry_msgs/msg/PolygonStamped",
    "nav_msgs/msg/Path",
)
TWO_PUBLISHERS = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: arm
    publishers:
      - {topic: all, type: visualization_msgs/msg/MarkerArray}
      - {topic: near, type: visualization_msgs/msg/MarkerArray, limits: {markers: {sequence: 2, string: 5}}}
limits: {"*": {string: 16, sequence: 6}}
transport: {mtu: 60000}
"""
DEPTH = 9


@pytest.fixture(scope="module")
def chosen(tmp_path_factory: pytest.TempPathFactory) -> Generated:
    rules = (LimitRule(("*",), string=13, sequence=5),)
    return generate(TYPES, rules, tmp_path_factory.mktemp("largest"), (shipped_folder(),))


def compile_c(source: Path, includes: list[str], option: str = "-m64") -> str:
    """Return what gcc says."""
    command = ["gcc", option, *WARNINGS, "-fsyntax-only", *includes, str(source)]
    return subprocess.run(command, capture_output=True, text=True, check=False).stderr


def with_wrong_size(header: Path, include: Path, name: str, by: int) -> list[str]:
    """Copy a header to a folder that is searched first, with another number; return the option of the compiler."""
    text, count = re.subn(
        rf"( {name}__MAX_ENCODED_SIZE = )(\d+)", lambda m: f"{m[1]}{int(m[2]) + by}", header.read_text()
    )
    assert count == 1
    place = include / header.parts[-4] / header.parts[-3] / "detail" / header.name
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text(text)
    return [f"-I{include}"]


@pytest.mark.parametrize("name", TYPES)
@pytest.mark.parametrize("by", [1, -1, 8])
def test_a_wrong_largest_size_does_not_compile(chosen: Generated, name: str, by: int, tmp_path: Path) -> None:
    found = chosen.plan(name)
    source = chosen.folder / found.files.type_support_source
    assert compile_c(source, chosen.includes) == ""
    wrong = with_wrong_size(chosen.folder / found.files.type_support, tmp_path, found.c_name, by)
    output = compile_c(source, wrong + chosen.includes)
    assert f"{found.c_name}__assert_max_encoded_size" in output


def test_each_part_is_computed_by_the_compiler(chosen: Generated, tmp_path: Path) -> None:
    """No line of the assertion is there for show: another end of any part does not compile."""
    found = chosen.plan("visualization_msgs/msg/MarkerArray")
    text = (chosen.folder / found.files.type_support_source).read_text()
    (block,) = re.finditer(r"__assert_max_encoded_size,(.*?)\);\n", text, re.DOTALL)
    ends = list(re.compile(r"== (\d+)U\)").finditer(text, *block.span(1)))
    assert len(ends) > 15
    for end in ends:
        wrong = tmp_path / "wrong.c"
        wrong.write_text(f"{text[: end.start(1)]}{int(end[1]) + 8}{text[end.end(1) :]}")
        assert "__assert_max_encoded_size" in compile_c(wrong, chosen.includes)


def test_wrong_limit_in_the_assertion_does_not_compile(chosen: Generated, tmp_path: Path) -> None:
    found = chosen.plan("sensor_msgs/msg/JointState")
    text = (chosen.folder / found.files.type_support_source).read_text()
    wrong = tmp_path / "wrong.c"
    for part in ("CDR_END_OF_STRING(8U, 13U)", "5U, 8U, 8U)"):
        wrong.write_text(text.replace(part, part.replace("13U", "14U").replace("5U", "6U")))
        assert "__assert_max_encoded_size" in compile_c(wrong, chosen.includes)


def test_wrong_size_of_a_publisher_does_not_compile(tmp_path: Path) -> None:
    """A type whose limits are a table in C, under those of one publisher."""
    (tmp_path / "microros.yaml").write_text(TWO_PUBLISHERS)
    options = compiler.Options(config=tmp_path / "microros.yaml", interface_paths=(shipped_folder(),))
    out = compiler.generate(options, tmp_path / "out").out
    includes = [f"-I{out / 'include'}"]
    source = out / "src" / "visualization_msgs" / "marker_array__type_support.c"
    header = out / "include" / "visualization_msgs" / "msg" / "detail" / "marker_array__type_support.h"
    assert compile_c(source, includes) == ""
    for name in ("visualization_msgs__msg__MarkerArray", "visualization_msgs__msg__MarkerArray__on__near"):
        wrong = with_wrong_size(header, tmp_path / "wrong", name, 4)
        assert f"{name}__assert_max_encoded_size" in compile_c(source, wrong + includes)


def test_text_grows_with_the_members(tmp_path: Path) -> None:
    """Sequences in sequences: a level more is a few lines more, and elements cost none."""
    folder = tmp_path / "deep_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "Level0.msg").write_text("bool flag\nfloat64 value\nstring name\n")
    for level in range(1, DEPTH):
        members = f"bool flag\nstring name\nfloat64[] values\nLevel{level - 1}[] levels\nuint8 last\n"
        (folder / f"Level{level}.msg").write_text(members)
    rules = (LimitRule(("*",), string=3, sequence=3),)
    deep = generate([f"deep_msgs/msg/Level{DEPTH - 1}"], rules, tmp_path / "out", (folder.parent,))
    found = deep.plan(f"deep_msgs/msg/Level{DEPTH - 1}")
    source = deep.folder / found.files.type_support_source
    assert found.max_encoded_size > 3 ** (DEPTH - 1) * 20
    assert source.read_text().count("U) &&\n") < 12 * DEPTH
    for option in ("-m64", "-m32"):
        assert compile_c(source, deep.includes, option) == ""


def test_sizes_above_16_bits_where_int_has_16(tmp_path: Path) -> None:
    """The macros compute with 32 bits whatever `int` has; clang knows targets where it has 16."""
    source = tmp_path / "wide.c"
    conditions = (
        "CDR_END_OF_STRING(65530U, 65000U) == 130535U",
        "CDR_END_OF_WSTRING(40000U, 40000U) == 200004U",
        "CDR_END_OF_STRINGS(8U, 3000U, 60U) == 204005U",
        "CDR_END_OF_WSTRINGS(8U, 3000U, 60U) == 732008U",
        "CDR_END_OF_SEQUENCE(40000U, 40000U, 8U, 8U) == 360008U",
        "CDR_END_OF_MESSAGES(30000U, 40U, 60U) == 600020U",
        "CDR_END_LIKE(600020U, 4U, 20U, 8U) == 600036U",
        "CDR_END_LIKE(600020U, 0U, 20U, 8U) == 0U",
    )
    checks = "".join(f"typedef char check_{i}[({c}) ? 1 : -1];\n" for i, c in enumerate(conditions))
    source.write_text(f'#include "microros/cdr_sizes.h"\n{checks}')
    header = f"-I{COMPONENTS / 'cdr' / 'include'}"
    run(["gcc", *WARNINGS, "-fsyntax-only", header, source])
    known = subprocess.run(["clang", "--print-targets"], capture_output=True, text=True, check=False).stdout
    if "msp430" not in known:
        pytest.skip("no clang with a target of 16 bits")
    run(["clang", "--target=msp430", "-ffreestanding", *WARNINGS, "-fsyntax-only", header, source])
