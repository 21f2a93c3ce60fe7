# SPDX-License-Identifier: Apache-2.0
"""What `init` writes is built with CMake, as its README says; tests/workspace/test_ci.py has one of them."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.environments import clean_environ
from tests.support.migrate.profiles import READY
from tests.support.migrate.proposals import Init
from tests.support.paths import ROOT

pytestmark = [pytest.mark.long, pytest.mark.builds]
BOARDS = ("qemu-microbit", "qemu-mps2-an386", "qemu-riscv32-virt")


def build(folder: Path) -> None:
    environment = clean_environ(
        XDG_CACHE_HOME=str(folder.parent / "cache"), microros_gen_DIR=str(ROOT / "cmake")
    )
    configure = ["cmake", "-S", ".", "-B", "build", "-G", "Ninja", f"-DMICROROS_GEN_PYTHON={sys.executable}"]
    for command in (configure, ["cmake", "--build", "build", "-j2"]):
        done = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("profile", READY)
def test_a_profile_for_this_machine(profile: str, init: Init, tmp_path: Path) -> None:
    assert init("app", "--profile", profile)[0] == 0
    build(tmp_path / "app")
    assert (tmp_path / "app/build/app").is_file()


def test_the_commands_of_its_readme(init: Init, tmp_path: Path) -> None:
    """All but those that go on until somebody ends them; what they start is in tests/e2e."""
    assert init("app")[0] == 0
    lines = re.findall(r"(?m)^    (.*?)(?: +#.*)?$", (tmp_path / "app/README.md").read_text())
    endless = ("microros-gen agent udp4 --port 8888", "build/app")
    assert [line for line in lines if line in endless] == list(endless)
    tool = tmp_path / "microros-gen"
    tool.write_text(f'#!/bin/sh\nPYTHONPATH={ROOT} exec {sys.executable} -m microros_gen "$@"\n')
    tool.chmod(0o755)
    path = f"{tmp_path}{os.pathsep}{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    cache = str(tmp_path / "cache")
    environment = clean_environ(PATH=path, XDG_CACHE_HOME=cache, microros_gen_DIR=str(ROOT / "cmake"))
    for line in lines:
        if line not in endless:
            done = subprocess.run(
                line,
                shell=True,
                cwd=tmp_path / "app",
                env=environment,
                capture_output=True,
                text=True,
                check=False,
            )
            assert done.returncode == 0, f"{line}\n{done.stdout}{done.stderr}"
    assert (tmp_path / "app/build/app").is_file()
    assert (tmp_path / "app/build/out/bin/pure_sender").is_file()


@pytest.mark.parametrize("board", BOARDS)
def test_a_board(board: str, init: Init, tmp_path: Path) -> None:
    assert init("fw", "--profile", "pure_sender", "--target", board)[0] == 0
    build(tmp_path / "fw")
    assert all((tmp_path / f"fw/build/fw{suffix}").is_file() for suffix in (".elf", ".hex", ".bin"))


def test_a_processor_without_a_board_has_a_library(init: Init, tmp_path: Path) -> None:
    assert init("fw", "--profile", "pure_reader", "--target", "cortex-m4f")[0] == 0
    build(tmp_path / "fw")
    assert (tmp_path / "fw/build/libfw.a").is_file()


@pytest.mark.parametrize("example", ["ping_pong", "add_two_ints_client", "static_types"])
def test_an_application_that_was_there(example: str, init: Init, tmp_path: Path) -> None:
    """Its sources are compiled where they are, with what was proposed for them."""
    assert init("app", "--from", str(ROOT / "examples" / example))[0] == 0
    build(tmp_path / "app")
    assert (tmp_path / "app/build/app").is_file()


def test_interfaces_of_the_users_own(init: Init, tmp_path: Path) -> None:
    messages = tmp_path / "my interfaces/robot_msgs/msg"
    messages.mkdir(parents=True)
    (messages / "Wheel.msg").write_text("string name\nfloat32 speed\n")
    source = tmp_path / "src/main.c"
    source.parent.mkdir()
    source.write_text(
        "#include <rcl/rcl.h>\n#include <rclc/rclc.h>\n#include <robot_msgs/msg/wheel.h>\n"
        "int main(void) {\n  rcl_allocator_t a = rcl_get_default_allocator();\n  rclc_support_t s;\n"
        "  rcl_node_t n;\n  rcl_publisher_t p;\n"
        "  if (rclc_support_init(&s, 0, NULL, &a) != RCL_RET_OK) return 1;\n"
        '  if (rclc_node_init_default(&n, "robot", "", &s) != RCL_RET_OK) return 1;\n'
        "  return rclc_publisher_init_default(&p, &n,\n"
        '    ROSIDL_GET_MSG_TYPE_SUPPORT(robot_msgs, msg, Wheel), "wheel") == RCL_RET_OK ? 0 : 1;\n}\n'
    )
    status, _, err = init("app", "--from", "src", "--interface-path", "my interfaces")
    assert (status, err) == (0, "")
    build(tmp_path / "app")
    assert (tmp_path / "app/build/app").is_file()
