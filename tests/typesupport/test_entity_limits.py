# SPDX-License-Identifier: Apache-2.0
"""Publishers with their own limits: separate storage, if another publisher of the type has larger limits.

test_own_encoders.py has the encoders.
"""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from microros_gen.cli import main as cli
from microros_gen.interfaces.find import shipped_folder
from tests.support.slices import first
from tests.support.typesupport.build import WARNINGS, run

pytestmark = [pytest.mark.skipif(shutil.which("gcc") is None, reason="no gcc"), pytest.mark.builds]

APPLICATION = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: arm
    publishers:
      - {topic: a/b, type: sensor_msgs/msg/JointState, limits: {name: {sequence: 2, string: 8}, position: 3}}
      - {topic: a_b, type: sensor_msgs/msg/JointState, limits: {header: {string: 3}}}
      - {topic: ~/all, type: sensor_msgs/msg/JointState}
      - {topic: text, type: std_msgs/msg/String, limits: {data: 30}}
      - {topic: same, type: std_msgs/msg/ColorRGBA}
  - name: leg
    publishers:
      - {topic: text, type: std_msgs/msg/String, limits: {data: 10}}
      - {topic: note, type: std_msgs/msg/String}
      - {topic: long, type: std_msgs/msg/String, limits: {data: 40}}
limits: {"*": {string: 16, sequence: 6}}
"""

PROGRAM = r"""
#include <sensor_msgs/msg/joint_state.h>
#include <std_msgs/msg/string.h>
#include <stdio.h>
#include <string.h>

#define STATE(b) do { static sensor_msgs__msg__JointState##b##__Storage s; sensor_msgs__msg__JointState m; \
  sensor_msgs__msg__JointState##b##__bind(&m, &s); \
  m.name.data[m.name.capacity - 1].data[m.name.data[m.name.capacity - 1].capacity - 1] = 0; \
  printf("%zu %zu %zu %zu %zu\n", m.header.frame_id.capacity, m.name.capacity, m.name.data[0].capacity, \
    m.position.capacity, m.effort.capacity); } while (0)
#define TEXT(b) do { static std_msgs__msg__String##b##__Storage s; std_msgs__msg__String m; \
  std_msgs__msg__String##b##__bind(&m, &s); \
  memset(m.data.data, 'x', m.data.capacity); \
  printf("%zu %zu\n", m.data.capacity, sizeof(s)); } while (0)

int main(void)
{
  STATE(__on__a_b);
  STATE(__on__a_b__2);
  STATE();
  TEXT(__on__text);
  TEXT(__on__note);
  TEXT();
  return 0;
}
"""


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("entities")
    (place / "microros.yaml").write_text(APPLICATION)
    options = ["-c", str(place / "microros.yaml"), "--interface-path", str(shipped_folder())]
    with pytest.raises(SystemExit) as done:
        cli.main(["generate", *options, "-o", str(place / "out")])
    assert done.value.code in (0, None)
    return place / "out"


@pytest.mark.parametrize("flags", first([("-fsanitize=address,undefined",), ("-m32",)]))
def test_each_topic_has_the_capacities_of_its_own_limits(out: Path, flags: tuple[str, ...]) -> None:
    """Topics with one name in C differ by a number; of one topic in two nodes the larger limit holds."""
    program = out.parent / "program.c"
    program.write_text(PROGRAM)
    sources = sorted((out / "src").rglob("*__storage.c"))
    image = out.parent / "program"
    run(["gcc", *flags, *WARNINGS, f"-I{out}/include", program, *sources, "-o", image])
    assert run([image]).splitlines() == [
        "17 2 9 3 6",
        "4 6 17 6 6",
        "17 6 17 6 6",
        "31 31",
        "17 17",
        "41 41",
    ]


def test_the_example_uses_the_storage_of_each_topic(out: Path) -> None:
    text = (out / "examples/pure_sender/main.c").read_text()
    used = re.findall(r"^static (\w+)__Storage", text, re.MULTILINE)
    assert used == [
        "sensor_msgs__msg__JointState__on__a_b",
        "sensor_msgs__msg__JointState__on__a_b__2",
        "sensor_msgs__msg__JointState",
        "std_msgs__msg__String__on__text",
        "std_msgs__msg__String__on__text",
        "std_msgs__msg__String__on__note",
        "std_msgs__msg__String",
    ]
    run(["gcc", *WARNINGS, "-fsyntax-only", f"-I{out}/include", out / "examples/pure_sender/main.c"])


def test_the_type_has_the_largest_of_all(out: Path) -> None:
    """The handle is shared by all publishers of the type: rmw_serialize and message sizes go by the largest limits."""
    header = (out / "include/std_msgs/msg/detail/string__type_support.h").read_text()
    assert "std_msgs__msg__String__MAX_ENCODED_SIZE = 45" in header
