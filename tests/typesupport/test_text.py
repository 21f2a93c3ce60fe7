# SPDX-License-Identifier: Apache-2.0
"""Comments, constants, literals and names in the generated text."""

from __future__ import annotations

import re
import time
from pathlib import Path

import pytest

from microros_gen.application.model import LimitRule
from microros_gen.diagnostics import UserError
from microros_gen.documents.templates import make_environment
from microros_gen.interfaces.types import Primitive
from microros_gen.typesupport.plan.names import snake_case
from microros_gen.typesupport.views.decode import render_decoders
from microros_gen.typesupport.views.text import comment_lines, number, string
from microros_gen.typesupport.views.types import render_types
from tests.support.ids import without_id
from tests.support.typesupport.build import TEST_RULES, WARNINGS, Generated, generate, run

pytestmark = pytest.mark.builds

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
    start = time.process_time()
    environment = make_environment()
    files = render_types(everything.plans, environment) | render_decoders(everything.plans, environment)
    elapsed = time.process_time() - start
    assert files == everything.files
    assert elapsed < 1.0


MOTOR = """
module a { module msg {
  module Motor_Constants {
    @verbatim (language="comment", text="Largest speed.") @unit (value="rpm") const uint16 MOST = 6000;
  };
  @verbatim (language="comment", text="State of a motor." "\\n" "Sent at 100 Hz.")
  struct Motor {
    @verbatim (language="comment", text="Shaft speed.") @unit (value="rpm") @range (min=-6000, max=6000)
    @default (value=100) short speed;
    @unit (value="degC") @min (-40.5) float temperature;
    @unit (value="A") sequence<float, 3> currents;
    @default (value="id/*le*/ é\t") string<16> mode;
    @verbatim (language="comment", text="Names.") sequence<wstring<4>, 2> names;
    @default (value="(1, 2, 3)") sequence<uint32> counts;
    @key uint8 id;
  };
}; };
"""


@pytest.fixture(scope="module")
def motor(tmp_path_factory: pytest.TempPathFactory) -> Generated:
    """A message whose .idl file says all that one can say."""
    folder = tmp_path_factory.mktemp("motor")
    (folder / "a/msg").mkdir(parents=True)
    (folder / "a/msg/Motor.idl").write_text(MOTOR, encoding="utf-8")
    return generate(["a"], (LimitRule(("*",), string=16, sequence=4),), folder / "out", [folder])


def test_a_struct_says_what_the_interface_file_says(motor: Generated) -> None:
    """Comments, units, ranges, bounds and default values precede the member that they belong to."""
    header = motor.files["include/a/msg/detail/motor__struct.h"].decode()
    assert "/** Largest speed. [rpm] */\nenum\n{\n  a__msg__Motor__MOST = 6000\n};" in header
    start = header.index(
        "/**\n * State of a motor.\n * Sent at 100 Hz.\n */\ntypedef struct a__msg__Motor\n{"
    )
    body = header[start:].partition("} a__msg__Motor;")[0]
    found = re.findall(r"(?:  /\*\*(.*?)\*/\n)?  [\w ]+? (\w+);\n", body, re.DOTALL)
    assert {name: [w.strip(" *") for w in text.strip().split("\n")] for text, name in found} == {
        "speed": ["Shaft speed. [rpm]", "Range: -6000 to 6000", "Default: 100"],
        "temperature": ["[degC]", "At least -40.5"],
        "currents": ["[A]", "At most 3 elements."],
        "mode": ["At most 16 bytes of UTF-8, without the terminator.", 'Default: "id/ *le* / é\\011"'],
        "names": ["Names.", "At most 2 elements.", "Each at most 4 UTF-16 units, without the terminator."],
        "counts": ["Default: {1U, 2U, 3U}"],
        "id": [""],
    }


def test_a_header_says_what_a_message_takes(motor: Generated) -> None:
    """Sizes are those that the C asserts."""
    plan = motor.plan("a/msg/Motor")
    header = motor.files["include/a/msg/motor.h"].decode()
    struct, storage = plan.struct_sizes, plan.storage_sizes
    sizes = f"{struct[1]} ({struct[0]}), storage {storage[1]} ({storage[0]}), body {plan.min_encoded_size} to"
    assert f" * - a__msg__Motor: {sizes} {plan.max_encoded_size}\n" in header
    kept = motor.files["include/a/msg/detail/motor__storage.h"].decode()
    assert f"/** Storage of one message: {storage[1]} bytes, {storage[0]} with 64-bit pointers. */" in kept
    assert "  char mode[17];  /* 16 bytes and the terminator */\n" in kept
    assert "  uint_least16_t names__text[2][5];  /* each 4 UTF-16 units and the terminator */\n" in kept
    for source in motor.sources(".c"):
        run(["gcc", *WARNINGS, "-fsyntax-only", *motor.includes, source])


def test_two_types_of_one_file_name_are_refused(tmp_path: Path) -> None:
    """HTTPServer and HttpServer give http_server.h both: neither may replace the other in silence."""
    for file, text in (
        ("msg/HTTPServer.msg", "int8 a"),
        ("msg/HttpServer.msg", "int8 a"),
        ("srv/DoIT.srv", "int8 a\n---\n"),
        ("srv/DoIt.srv", "int8 a\n---\n"),
        ("srv/HttpServer.srv", "---\n"),
    ):
        (tmp_path / "twice" / file).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "twice" / file).write_text(text)
    with pytest.raises(UserError) as raised:
        generate(["twice"], TEST_RULES, tmp_path / "out", [tmp_path])
    found = [without_id(d.headline()) for d in raised.value.diagnostics]
    assert len(found) == 2
    assert re.search(
        r"HttpServer\.msg:1:1: error: twice/msg/HttpServer and twice/msg/HTTPServer have the same header",
        found[0],
    )
    assert "have the same header in C, twice/srv/do_it.h. Rename one of them" in found[1]
