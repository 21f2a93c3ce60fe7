# SPDX-License-Identifier: Apache-2.0
"""Headers of interfaces that a program includes are in the library that `init` proposes, with or without an entity."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from microros_gen.documents.files import read_text
from tests.support.migrate.proposals import Init, application_in, undecided_in
from tests.support.migrate.rclc import NODE

MAIN = """
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/string.h>
#include <geometry_msgs/msg/vector3.h>
#include "sensor_msgs/msg/detail/laser_scan__struct.h"
MORE
int main(void)
{
  NODE
  rclc_publisher_init_default(&p, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count");
  rclc_publisher_init_default(&q, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(geometry_msgs, msg, Twist), "twist");
}
""".replace("NODE", NODE)


def proposed(init: Init, folder: Path, more: str) -> tuple[int, str]:
    """Return exit status and messages of `init` for the program with `more` lines."""
    (folder / "main.c").write_text(MAIN.replace("MORE", more))
    status, _, error = init("app", "--from", "main.c")
    return status, error


def test_types_without_an_entity_become_interfaces(init: Init, tmp_path: Path) -> None:
    assert proposed(init, tmp_path, "") == (0, "")
    named = [interface.name for interface in application_in(tmp_path / "app/microros.yaml").interfaces]
    assert named == ["sensor_msgs/msg/LaserScan", "std_msgs/msg/String"]


def test_an_unknown_package_names_the_line_of_its_header(init: Init, tmp_path: Path) -> None:
    status, error = proposed(init, tmp_path, "#include <arm_msgs/srv/set_gains.h>")
    assert status == 2
    text = "main.c:7:1: error: arm_msgs/srv/set_gains.h: unknown interface package 'arm_msgs'."
    assert f"{text} Add --interface-path and the folder of the package [MG-9099]\n" in error
    assert "  #include <arm_msgs/srv/set_gains.h>\n" in error


def test_an_unknown_type_names_the_command_that_lists_them(init: Init, tmp_path: Path) -> None:
    status, error = proposed(init, tmp_path, "#include <std_msgs/msg/integer.h>")
    assert status == 2
    assert (
        "the interface package 'std_msgs' has no such type. `microros-gen interfaces std_msgs` lists" in error
    )


def test_that_command_has_the_places_of_the_packages(init: Init, tmp_path: Path) -> None:
    messages = tmp_path / "my ws/arm_msgs/msg"
    messages.mkdir(parents=True)
    (messages / "Gains.msg").write_text("float64 p\n")
    (tmp_path / "main.c").write_text(MAIN.replace("MORE", "#include <arm_msgs/msg/gain.h>"))
    status, _, error = init("app", "--from", "main.c", "--interface-path", "my ws")
    assert status == 2
    assert "`microros-gen interfaces arm_msgs --interface-path 'my ws'` lists its types" in error


def test_what_may_not_be_compiled_is_left_to_the_user(init: Init, tmp_path: Path) -> None:
    more = "#ifdef WITH_ARM\n#include <arm_msgs/srv/set_gains.h>\n#endif"
    status, error = proposed(init, tmp_path, more)
    assert status == 0
    assert "main.c:8:1: warning: arm_msgs/srv/set_gains.h: unknown interface package 'arm_msgs'" in error
    assert len(undecided_in(tmp_path / "app/microros.yaml")) == 1


def test_a_header_that_nothing_needs_is_refused_with_its_line(init: Init, tmp_path: Path) -> None:
    status, error = proposed(
        init, tmp_path, "#include <std_msgs/msg/rosidl_generator_c__visibility_control.h>"
    )
    assert status == 2
    assert (
        "main.c:7:1: error: std_msgs/msg/rosidl_generator_c__visibility_control.h: the library has no"
        in error
    )
    assert "such header, nor a use for it. Remove the line [MG-9099]" in error


def test_a_node_without_a_known_name_leaves_all_types(init: Init, tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text(MAIN.replace("MORE", "").replace('"n"', "name()"))
    status, _, error = init("app", "--from", "main.c")
    assert (status, "the name of the node: `name()` is worked out" in error) == (0, True)
    named = [interface.name for interface in application_in(tmp_path / "app/microros.yaml").interfaces]
    types = [
        "geometry_msgs/msg/Twist",
        "sensor_msgs/msg/LaserScan",
        "std_msgs/msg/Int32",
        "std_msgs/msg/String",
    ]
    assert named == types


def test_a_header_of_the_program_is_no_interface(init: Init, tmp_path: Path) -> None:
    header = tmp_path / "src/arm_msgs/msg/gains.h"
    header.parent.mkdir(parents=True)
    header.write_text("struct gains;\n")
    (tmp_path / "src/main.c").write_text(MAIN.replace("MORE", "#include <arm_msgs/msg/gains.h>"))
    assert init("app", "--from", "src")[0] == 0


def test_a_file_that_cannot_be_read_hides_no_other_fault(
    init: Init, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def locked(path: Path, errors: str) -> str:
        if path.name in ("a.c", "b.c"):
            raise PermissionError(13, "Permission denied")
        return read_text(path, errors=errors)

    monkeypatch.setattr("microros_gen.migrate.code.read_text", locked)
    sources = tmp_path / "src"
    sources.mkdir()
    for name in ("a.c", "b.c"):
        (sources / name).write_text("int main(void) {}\n")
    (sources / "c.h").write_text("#include <own_msgs/msg/gains.h>\n")
    (tmp_path / "colcon.meta").write_text('{"names": 3}')
    status, _, error = init("app", "--from", "src", "--from-colcon-meta", "colcon.meta")
    assert status == 2
    faults = [line for line in error.splitlines() if ": error: " in line]
    places = [re.findall(r"colcon\.meta:1|src/\w\.[ch](?::1:1)?", fault) for fault in faults]
    assert places == [["colcon.meta:1"], ["src/a.c"], ["src/b.c"], ["src/c.h:1:1"]], error
    assert "call no function of rclc" not in error, "they may be in what cannot be read"
    assert not (tmp_path / "app").exists()


ODOMETRY = """
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <nav_msgs/msg/odometry.h>
int main(void)
{
  rmw_uros_set_custom_transport(true, NULL, line_open, line_close, line_write, line_read);
  NODE
  rclc_publisher_init_best_effort(&p, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(nav_msgs, msg, Odometry), "odom");
}
""".replace("NODE", NODE)


def test_a_message_that_fits_no_datagram_gets_a_larger_mtu(init: Init, tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text(ODOMETRY)
    status, _, error = init("app", "--from", "main.c")
    assert (status, error) == (0, "")
    mtu = application_in(tmp_path / "app/microros.yaml").transport.mtu
    assert mtu is not None
    assert 720 < mtu < 1024, "36 and 37 float64 are 600 bytes, and there are two names"
    assert undecided_in(tmp_path / "app/microros.yaml") == []


def test_an_mtu_of_the_settings_is_not_changed(init: Init, tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text(ODOMETRY)
    (tmp_path / "colcon.meta").write_text(
        '{"names": {"microxrcedds_client": {"cmake-args": ["-DUCLIENT_CUSTOM_TRANSPORT_MTU=300"]},'
        ' "rmw_microxrcedds": {"cmake-args": ["-DRMW_UXRCE_TRANSPORT=custom"]}}}'
    )
    status, _, error = init("app", "--from", "main.c", "--from-colcon-meta", "colcon.meta")
    assert status == 2
    assert "MG-7028" in error
    assert application_in(tmp_path / "app/microros.yaml").transport.mtu == 300
