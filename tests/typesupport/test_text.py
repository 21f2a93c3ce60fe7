# SPDX-License-Identifier: Apache-2.0
"""Comments, constants, literals and names in the generated text."""

from __future__ import annotations

import re
import time
from pathlib import Path

import pytest
from ts_build import TEST_RULES, WARNINGS, Generated, generate, run

from microros_gen.model.types import Primitive
from microros_gen.plan.types_names import snake_case
from microros_gen.render.environment import make_environment
from microros_gen.render.types import render_types
from microros_gen.render.types_decode import render_decoders
from microros_gen.render.types_text import comment_lines, number, string

NASTY = """# Speed [m/s] */ int injected; /* and more
# trigraph ??/
# ends with a backslash \\
# "quotes" 'and' → arrows % {{ braces }} {% raw %}

uint32 BIG=4294967295         # does not fit int
int64 LOW=-9223372036854775808
int32 MINIMUM=-2147483648
uint64 HIGH=18446744073709551615
float32 RATIO=0.1
float64 TINY=1e-300
bool YES=true
string TEXT="a\\"b\\\\ ??/ é %s"
# Distance to the obstacle [m]. */
float32 range -1.5
int8[3] steps [-128, 0, 127]
uint64 most 18446744073709551615
int64 least -9223372036854775808
string name "tab?? é"
wstring wide "ハ\U0001f600"
string[2] pair ["", "x"]
string[<=3] few ["p", ""]
float64[] weights [0.5, 1e10]
bool[2] flags [false, true]
"""


@pytest.fixture(scope="module")
def nasty(tmp_path_factory: pytest.TempPathFactory) -> Generated:
    folder = tmp_path_factory.mktemp("nasty")
    package = folder / "in" / "nasty_msgs"
    (package / "msg").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>nasty_msgs</name></package>")
    (package / "msg" / "HTTPNasty2Type.msg").write_text(NASTY, encoding="utf-8")
    return generate(["nasty_msgs"], TEST_RULES, folder / "out", paths=[package])


def test_nasty_text_compiles_without_a_warning(nasty: Generated) -> None:
    for compiler in ("gcc", "clang"):
        for source in nasty.sources(".c"):
            run([compiler, *WARNINGS, "-fsyntax-only", *nasty.includes, source])


def test_comments_and_units_travel(nasty: Generated) -> None:
    header = nasty.files["include/nasty_msgs/msg/detail/http_nasty2_type__struct.h"].decode()
    assert "Speed [m/s] * / int injected; / * and more" in header
    assert "Distance to the obstacle [m]. * /" in header
    assert "{{ braces }} {% raw %}" in header
    declaration = header.index("float range;")
    assert header.index("Distance to the obstacle") < declaration
    assert "??" not in header


def test_values_survive(nasty: Generated, tmp_path: Path) -> None:
    """The C compiler reads constants and default values as the .msg file means them."""
    name = "nasty_msgs__msg__HTTPNasty2Type"
    program = tmp_path / "values.c"
    program.write_text(f"""
#include <stdio.h>
#include "nasty_msgs/msg/http_nasty2_type.h"
#include "rcutils/allocator.h"
rcutils_allocator_t rcutils_get_default_allocator(void) {{ rcutils_allocator_t none = {{0}}; return none; }}
static {name}__Storage storage;
int main(void) {{
  {name} m;
  {name}__bind(&m, &storage);
  printf("%u %lld %d %llu\\n", {name}__BIG, (long long){name}__LOW, (int){name}__MINIMUM,
    (unsigned long long){name}__HIGH);
  printf("%.9g %.17g %d %s\\n", (double){name}__RATIO, {name}__TINY, (int){name}__YES, {name}__TEXT);
  printf("%g %d %d %d %llu %lld\\n", (double)m.range, m.steps[0], m.steps[1], m.steps[2],
    (unsigned long long)m.most, (long long)m.least);
  printf("%s %zu %x %x %x %zu\\n", m.name.data, m.name.size, (unsigned)m.wide.data[0],
    (unsigned)m.wide.data[1], (unsigned)m.wide.data[2], m.wide.size);
  printf("<%s> <%s> %zu <%s> <%s>\\n", m.pair[0].data, m.pair[1].data, m.few.size,
    m.few.data[0].data, m.few.data[1].data);
  printf("%zu %g %g %d %d\\n", m.weights.size, m.weights.data[0], m.weights.data[1], m.flags[0], m.flags[1]);
  return 0;
}}
""")
    output = tmp_path / "values"
    options = ["-std=c99", "-ffunction-sections", "-Wl,--gc-sections", "-w", "-trigraphs"]
    run(["gcc", *options, *nasty.includes, program, *nasty.sources(".c"), "-o", output])
    assert run([output]).splitlines() == [
        "4294967295 -9223372036854775808 -2147483648 18446744073709551615",
        '0.100000001 1e-300 1 a"b\\ ??/ é %s',
        "-1.5 -128 0 127 18446744073709551615 -9223372036854775808",
        "tab?? é 8 30cf d83d de00 3",
        "<> <x> 2 <p> <>",
        "2 0.5 1e+10 0 1",
    ]


@pytest.mark.parametrize(
    ("camel", "snake"),
    [
        ("Int32", "int32"),
        ("HTTPNasty2Type", "http_nasty2_type"),
        ("UInt8MultiArray", "u_int8_multi_array"),
        ("PointCloud2", "point_cloud2"),
        ("TFMessage", "tf_message"),
        ("MultiDOFJointState", "multi_dof_joint_state"),
    ],
)
def test_file_names_are_those_of_rosidl(camel: str, snake: str) -> None:
    assert snake_case(camel) == snake


def test_literals() -> None:
    assert number(Primitive.INT64, -(2**63)) == "INT64_MIN"
    assert number(Primitive.UINT8, 255) == "255"
    assert number(Primitive.FLOAT32, 1.0) == "1.0f"
    assert number(Primitive.FLOAT64, float("-inf")) == "-INFINITY"
    assert string('a"\n??/é') == '"a\\"\\012\\?\\?/\\303\\251"'
    assert comment_lines(("", "x */", "", "y \\", "")) == ("x * /", "", "y \\.")


@pytest.mark.ros
def test_text_of_every_file(everything: Generated) -> None:
    """No tab, no blank at an end of line, one line end at the end; guards are unique, not reserved."""
    guards = []
    for path, content in everything.files.items():
        text = content.decode("utf-8")
        assert re.match(r"/\* Generated by microros-gen from \w+/(msg|srv|action)/\w+\. \*/\n", text), path
        assert "SPDX" not in text, (
            f"{path}: what derives from the user's files carries no claim of this project"
        )
        assert text.endswith("\n"), path
        assert not text.endswith("\n\n"), path
        assert "\n\n\n" not in text, path
        assert not re.search(r"[ \t]\n|\r|\t", text), path
        guards += re.findall(r"#ifndef (\w+)\n#define \1\n", text)
    assert len(guards) == len(set(guards)) == sum(path.endswith(".h") for path in everything.files)
    assert not any(guard.startswith("_") for guard in guards)


@pytest.mark.ros
def test_rendering_is_repeatable_and_fast(everything: Generated) -> None:
    """Same bytes from a new environment; far below the budget of a generation (0.3 s for 169 types, of 304 here)."""
    start = time.perf_counter()
    environment = make_environment()
    files = render_types(everything.plans, environment) | render_decoders(everything.plans, environment)
    elapsed = time.perf_counter() - start
    assert files == everything.files
    assert elapsed < 1.0
