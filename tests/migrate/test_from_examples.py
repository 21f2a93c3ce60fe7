# SPDX-License-Identifier: Apache-2.0
"""`init --from` on the applications of examples/: it proposes what their own microros.yaml declares."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from microros_gen.selection.find_profiles import load_builtin_profiles
from tests.support.ids import without_id
from tests.support.migrate.proposals import Init, application_in, entities_of, undecided_in
from tests.support.paths import ROOT

EXAMPLES = ROOT / "examples"
APPLICATIONS = sorted(path.parent.name for path in EXAMPLES.glob("*/main.c"))


JOINTS = "sensor_msgs/msg/JointState"
STATUS = "diagnostic_msgs/msg/DiagnosticStatus"
# ping_pong gives a frame_id 32 bytes, static_types describes its message by rules, time_sync by a text.
LIMITS = {
    # Examples of actions declare 20 numbers; their sources do not say how many.
    "fibonacci_client": {("*",): (64, 16)},
    "fibonacci_server": {
        ("*",): (64, 16),
        ("example_interfaces/action/Fibonacci_FeedbackMessage", "feedback"): (None, 20),
        ("example_interfaces/action/Fibonacci_GetResult_Response", "result"): (None, 20),
    },
    "ping_pong": {("std_msgs/msg/Header", "frame_id"): (31, 31)},
    "parameters": {
        (STATUS, "name"): (6, 6),
        (STATUS, "message"): (14, 14),
        (STATUS, "values", "key"): (7, 7),
        ("*",): (64, 16),
    },
    "time_sync": {("std_msgs/msg/Header", "frame_id"): (5, 5)},
    "static_types": {
        (JOINTS, "header", "frame_id"): (16, 16),
        (JOINTS, "name"): (16, 6),
        (JOINTS, "position"): (6, 6),
        (JOINTS, "velocity"): (1, 1),
        (JOINTS, "effort"): (1, 1),
    },
}


PROFILES = {"parameters": {"pure_sender"}}
"""Proposals that name the components of the example's profile instead."""


def test_there_are_examples() -> None:
    assert len(APPLICATIONS) >= 11


@pytest.mark.parametrize("name", APPLICATIONS)
def test_the_proposal_is_what_the_example_declares(name: str, init: Init, tmp_path: Path) -> None:
    status, _, err = init("app", "--from", str(EXAMPLES / name))
    assert (status, err) == (0, "")
    assert undecided_in(tmp_path / "app/microros.yaml") == []
    proposed = application_in(tmp_path / "app/microros.yaml")
    declared = application_in(EXAMPLES / name / "microros.yaml")
    assert entities_of(proposed) == entities_of(declared)
    assert proposed.transport.type == declared.transport.type
    assert proposed.transport.framing == declared.transport.framing
    writers = {f"logging_{writer.to}" for writer in declared.logging}
    profiles = [load_builtin_profiles()[profile.name] for profile in declared.profiles]
    selected = {c.name for c in declared.components}
    selected |= {c.name for profile in profiles for c in profile.components}
    assert {c.name for c in proposed.components} <= selected | writers
    assert {p.name for p in proposed.profiles} == PROFILES.get(name, {p.name for p in declared.profiles})
    limits = {rule.path: (rule.string, rule.sequence) for rule in proposed.limits}
    assert limits == LIMITS.get(name, {})
    # The sources stay where they are, and nobody asked for a golden copy.
    assert not (tmp_path / "app/golden").exists()
    assert not (tmp_path / "app/.github").exists()
    assert not (tmp_path / "app/main.c").exists()


def test_all_examples_at_once_are_several_applications(init: Init, tmp_path: Path) -> None:
    status, _, err = init("app", "--from", str(EXAMPLES))
    assert status == 2
    first = without_id(err.splitlines()[0])
    assert "error: several applications in these sources: main() is also in" in first
    assert first.endswith("Give the folder or file of one of them")
    assert not (tmp_path / "app").exists()


def test_sources_and_settings_together(init: Init, tmp_path: Path) -> None:
    """The nodes of the sources make the numbers of the settings unnecessary; the rest of both holds."""
    arguments = [
        "-DRMW_UXRCE_MAX_PUBLISHERS=9",
        "-DRMW_UXRCE_STREAM_HISTORY=2",
        "-DRMW_UXRCE_TRANSPORT=serial",
    ]
    meta = {"names": {"rmw_microxrcedds": {"cmake-args": arguments}}}
    (tmp_path / "a.meta").write_text(json.dumps(meta))
    status, _, err = init("app", "--from", str(EXAMPLES / "subscriber"), "--from-colcon-meta", "a.meta")
    assert (status, err) == (0, "")
    application = application_in(tmp_path / "app/microros.yaml")
    assert entities_of(application) == entities_of(application_in(EXAMPLES / "subscriber/microros.yaml"))
    assert (application.pools, application.transport.type) == ({"history": 2}, "serial")
    text = (tmp_path / "app/microros.yaml").read_text()
    assert "RMW_UXRCE_MAX_PUBLISHERS=9: `nodes` declares the entities" in text.replace("\n#  ", "")


def test_a_package_that_is_not_found_is_an_error_in_the_proposal(init: Init, tmp_path: Path) -> None:
    source = (EXAMPLES / "subscriber/main.c").read_text(encoding="utf-8")
    (tmp_path / "src/golden").mkdir(parents=True)
    (tmp_path / "src/main.c").write_text(source.replace("std_msgs, msg, Int32", "robot_msgs, msg, Wheel"))
    # What this tool wrote is not read, nor what a build left.
    (tmp_path / "src/golden/manifest.json").write_text("{}")
    (tmp_path / "src/golden/main.c").write_text(source)
    (tmp_path / "src/build").mkdir()
    (tmp_path / "src/build/main.c").write_text(source)
    status, out, err = init("app", "--from", "src")
    assert status == 2
    assert re.search(r"^app/microros\.yaml:\d+:\d+: error: unknown interface package 'robot_msgs'", err)
    assert "golden copy" not in out
    assert not (tmp_path / "app/golden").exists()
    assert [
        line.strip() for line in (tmp_path / "app/CMakeLists.txt").read_text().splitlines() if "src" in line
    ] == [
        '"../src/main.c"',
        '"../src"',
    ]


JOINTS = """#include <rcl/rcl.h>
#include <sensor_msgs/msg/joint_state.h>
#include <rcl_interfaces/msg/parameter_event.h>
static sensor_msgs__msg__JointState joints;
int main(void)
{
  rclc_node_init_default(&node, "n", "", &support);
  rclc_publisher_init_default(&p, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, JointState), "joints");
  rclc_publisher_init_default(&e, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(rcl_interfaces, msg, ParameterEvent), "events");
  joints.name.capacity = 4;
  joints.position.capacity = 6;
}
"""


def test_what_is_proposed_is_taken(init: Init, tmp_path: Path) -> None:
    """One number for a sequence of strings is two things, and 64 and 16 make events larger than a message can be."""
    (tmp_path / "main.c").write_text(JOINTS)
    status, _, err = init("app", "--from", "main.c")
    assert (status, err) == (0, "")
    application = application_in(tmp_path / "app/microros.yaml")
    limits = {rule.path: (rule.string, rule.sequence) for rule in application.limits}
    assert limits["sensor_msgs/msg/JointState", "name"] == (None, 4)
    assert limits["sensor_msgs/msg/JointState", "position"] == (6, 6)
    assert limits["*",] == (32, 8)


MISSING = """#include <rcl/rcl.h>
int main(void)
{
  rclc_node_init_default(&node, "n", "", &support);
  rcl_no_such_call(&node);
  rcl_no_such_call(&client);
  return 0;
}
"""


def test_what_is_not_there_is_refused(init: Init, tmp_path: Path) -> None:
    """Once, at the first call; nobody is told to build what does not build."""
    (tmp_path / "main.c").write_text(MISSING)
    status, out, err = init("app", "--from", "main.c")
    assert status == 2
    first, code, mark = without_id(err).splitlines()
    assert first.startswith("main.c:5:3: error: rcl_no_such_call is not in this version")
    assert first.endswith("Remove the call and what belongs to it")
    assert (code.strip(), mark.strip()) == (
        "rcl_no_such_call(&node);",
        "^" + "~" * 15,
    )
    assert len(undecided_in(tmp_path / "app/microros.yaml")) == 1
    assert "cmake" not in out
    assert "does not build" in out
