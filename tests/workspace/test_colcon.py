# SPDX-License-Identifier: Apache-2.0
"""A colcon workspace, with ament and rosidl of ROS 2: interface packages, and firmware with their interfaces."""

from __future__ import annotations

import json
import re
import shlex
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from tests.support.environments import clean_environ, install
from tests.support.paths import ROOT
from tests.support.workspace.projects import replace
from tests.support.workspace.ros_environments import (
    COMMANDS,
    WORKSPACE,
    clone,
    environ,
    ros_environment,
    shell,
)

pytestmark = pytest.mark.long
BUILD = "colcon build --parallel-workers 1 --event-handlers console_cohesion+ --cmake-args -G Ninja"


@dataclass(frozen=True)
class Built:
    """A workspace that was built, and the environment that it was built in."""

    folder: Path
    environment: dict[str, str]

    def installed(self, package: str, path: str = "") -> Path:
        return self.folder / "install" / package / path

    def build(self) -> str:
        done = shell(self.folder, self.environment, BUILD)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    """The workspace after `colcon build`, where the wheel of this project is besides ROS 2."""
    try:
        environment = ros_environment()
    except OSError as error:
        pytest.skip(f"no ROS 2 from PyPI: {error}")
    base = tmp_path_factory.mktemp("colcon")
    subprocess.run(
        install(environment, ["--no-deps", "--force-reinstall", str(ROOT)]), env=clean_environ(), check=True
    )
    shutil.copytree(WORKSPACE, base / "a workspace" / "src")
    workspace = Built(base / "a workspace", environ(environment, base / "cache"))
    workspace.build()
    return workspace


def robot_as_rosbags_writes_it(built: Built) -> bytes:
    """Return the message of wire.c, by another writer of CDR."""
    store = get_typestore(Stores.EMPTY)
    for package, name in (("base_interfaces", "Wheel"), ("robot_interfaces", "Robot")):
        text = (built.folder / f"src/{package}/msg/{name}.msg").read_text()
        store.register(get_types_from_msg(text, f"{package}/msg/{name}"))
    store.register(get_types_from_msg("int32 sec\nuint32 nanosec\n", "builtin_interfaces/msg/Time"))
    types = store.types
    wheels = [types["base_interfaces/msg/Wheel"](name="", speed=speed) for speed in (0.5, 6.25)]
    stamp = types["builtin_interfaces/msg/Time"](sec=7, nanosec=0)
    robot = types["robot_interfaces/msg/Robot"](stamp=stamp, wheels=wheels, spare=[], name="")
    return bytes(store.serialize_cdr(robot, "robot_interfaces/msg/Robot"))[4:]


def hashes(manifest: Path) -> dict[str, str]:
    return {name: entry["hash"] for name, entry in json.loads(manifest.read_text())["types"].items()}


def rosidl_hashes(built: Built) -> dict[str, str]:
    """Return the type hashes that rosidl installed with the interfaces of the workspace."""
    found: dict[str, str] = {}
    for path in built.folder.glob("install/*_interfaces/share/*_interfaces/*/*.json"):
        found |= {
            entry["type_name"]: entry["hash_string"] for entry in json.loads(path.read_text())["type_hashes"]
        }
    return found


@pytest.mark.parametrize("package", ["base_interfaces", "robot_interfaces"])
def test_an_interface_package_has_its_type_support(built: Built, package: str) -> None:
    library = f"{package}__rosidl_generator_microros"
    index = built.installed(package, "share/ament_index/resource_index")
    assert (index / "rosidl_generator_microros" / package).read_text() == library
    assert (index / "rosidl_interfaces" / package).is_file()
    assert built.installed(package, f"lib/lib{library}.a").is_file()
    assert built.installed(package, f"include/{package}/{library}/{package}/msg").is_dir()
    known = rosidl_hashes(built)
    own = hashes(built.installed(package, f"share/{package}/microros/{library}/manifest.json"))
    assert own == {name: known[name] for name in own}
    assert any(name.startswith(package) for name in own)


def test_what_uses_an_interface_package_in_ros_does_not_see_it(built: Built) -> None:
    """Neither its headers nor its library are among the targets that find_package exports."""
    folder = built.installed("base_interfaces", "share/base_interfaces/cmake")
    extras = (folder / "ament_cmake_export_targets-extras.cmake").read_text()
    assert "base_interfaces__rosidl_generator_c" in extras
    assert "microros" not in extras


def test_a_program_writes_what_another_writer_of_cdr_writes(built: Built) -> None:
    program = built.installed("robot_firmware", "lib/robot_firmware/wire")
    written = subprocess.run([program], capture_output=True, check=True).stdout
    assert written == robot_as_rosbags_writes_it(built)


def test_the_firmware_is_installed_with_its_library(built: Built) -> None:
    package = "robot_firmware"
    assert built.installed(package, "lib/librobot.a").is_file()
    assert built.installed(package, "lib/robot_firmware/firmware").is_file()
    assert built.installed(package, f"include/{package}/robot/robot_interfaces/msg/robot.h").is_file()
    known = rosidl_hashes(built)
    own = hashes(built.installed(package, f"share/{package}/microros/robot/manifest.json"))
    assert own == {name: known[name] for name in own}
    assert "robot_interfaces/msg/Robot" in own


def test_a_changed_message_reaches_the_firmware_and_nothing_else_is_built_again(built: Built) -> None:
    built.build()  # the first one installed what the second one looks at
    idle = built.build()
    assert "Building C object" not in idle
    assert "ninja: no work to do." in idle.partition("output: robot_firmware")[2]
    manifest = built.installed("robot_firmware", "share/robot_firmware/microros/robot/manifest.json")
    before = hashes(manifest)
    replace(
        built.folder / "src/base_interfaces/msg/Wheel.msg", "float32 speed", "float32 radius\nfloat32 speed"
    )
    output = built.build()
    after = hashes(manifest)
    changed = {name for name, value in after.items() if before[name] != value}
    assert changed == {"base_interfaces/msg/Wheel", "robot_interfaces/msg/Robot"}
    assert after["base_interfaces/msg/Wheel"] == rosidl_hashes(built)["base_interfaces/msg/Wheel"]
    assert "src/rosidl_runtime/string.c" not in output
    assert "src/robot_interfaces/robot__type_support.c" in output


@pytest.mark.skipif(shutil.which("arm-none-eabi-gcc") is None, reason="no arm-none-eabi-gcc")
def test_the_commands_of_the_page(built: Built) -> None:
    """They build again, then for a board from the interfaces of the sourced workspace; and `rosidl` generates."""
    done = shell(built.folder, built.environment, "set -e\n" + "".join(COMMANDS))
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"^Image .*/firmware for host: \d+ bytes of flash", done.stdout, re.MULTILINE)
    image = built.folder / "install_m4/robot_firmware/lib/robot_firmware/firmware.elf"
    assert image.read_bytes()[:4] == b"\x7fELF"
    manifest = json.loads((built.folder / "build_m4/robot_firmware/robot-microros/manifest.json").read_text())
    assert manifest["target"] == "qemu-mps2-an386"
    assert hashes(built.folder / "out/manifest.json").keys() >= {"robot_interfaces/msg/Robot"}


def test_a_budget_is_checked_as_build_checks_it(built: Built, tmp_path: Path) -> None:
    shutil.copytree(WORKSPACE / "robot_firmware", tmp_path / "src/robot_firmware")
    config = tmp_path / "src/robot_firmware/microros.yaml"
    config.write_text(f"{config.read_text()}memory: {{ram_budget: 1 KiB}}\n")
    source = f". {shlex.quote(str(built.folder / 'install/local_setup.sh'))}\n"
    done = shell(tmp_path, built.environment, source + BUILD)
    assert done.returncode != 0
    output = done.stdout + done.stderr
    assert re.search(
        r"microros\.yaml:8:22: error: static RAM in the image: \d+ bytes, and memory.ram_budget is 1024",
        output,
    )


def test_a_mistake_in_the_application_file_is_reported_as_by_the_tool(built: Built, tmp_path: Path) -> None:
    shutil.copytree(WORKSPACE / "robot_firmware", tmp_path / "src/robot_firmware")
    replace(tmp_path / "src/robot_firmware/microros.yaml", "msg/Robot", "msg/Robott")
    source = f". {shlex.quote(str(built.folder / 'install/local_setup.sh'))}\n"
    done = shell(tmp_path, built.environment, source + BUILD)
    assert done.returncode != 0
    assert "src/robot_firmware/microros.yaml:6:39: error: " in done.stdout + done.stderr


def test_a_clone_in_a_workspace_brings_its_packages(built: Built, tmp_path: Path) -> None:
    clone(tmp_path / "src/microros_gen")
    listed = shell(tmp_path, built.environment, "colcon list --names-only")
    names = ["ament_cmake_microros", "microros_gen_agent", "rosidl_generator_microros"]
    assert listed.stdout.split() == names, listed.stderr
    done = shell(tmp_path, built.environment, f"{BUILD} --packages-select microros_gen_agent")
    assert done.returncode == 0, done.stdout + done.stderr
    program = tmp_path / "install/microros_gen_agent/lib/microros_gen_agent/micro_ros_agent"
    shown = shell(
        tmp_path, built.environment, f". install/local_setup.sh\n{shlex.quote(str(program))} --help"
    )
    assert shown.stdout.startswith("Usage: "), shown.stderr
