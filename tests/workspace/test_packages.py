# SPDX-License-Identifier: Apache-2.0
"""The ament packages without colcon and without ROS's other generators: built from a clone, used by CMake alone.

What is in the run by default; the whole, with everything that ROS 2 generates next to it, is in test_colcon.py.
"""

from __future__ import annotations

import importlib.metadata
import os
import re
import runpy
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from microros_gen import __version__
from tests.support.agent.process import own_domain, running_agent
from tests.support.environments import clean_environ
from tests.support.paths import ROOT
from tests.support.workspace.ros_environments import WORKSPACE

AMENT = ROOT / "cmake" / "ament"
NAMES = ("ament_cmake_microros", "rosidl_generator_microros")
ONLY_OURS = "find_package(rosidl_cmake REQUIRED)\nfind_package(rosidl_generator_microros REQUIRED)\n"


def cmake(source: Path, prefix: Path, *options: str) -> str:
    """Configure, build and install a package; return the messages."""
    build = prefix.parent / "build" / source.name
    environment = clean_environ(
        PATH=os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]),
        CMAKE_PREFIX_PATH=str(prefix),
        AMENT_PREFIX_PATH=os.pathsep.join([str(prefix), sys.prefix]),
        XDG_CACHE_HOME=str(prefix.parent / "cache"),
    )
    configure = [
        "-S",
        str(source),
        "-B",
        str(build),
        "-G",
        "Ninja",
        f"-DCMAKE_INSTALL_PREFIX={prefix}",
        *options,
    ]
    output = ""
    for command in (["cmake", *configure], ["cmake", "--build", str(build), "--target", "install"]):
        done = subprocess.run(command, env=environment, text=True, capture_output=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        output += done.stdout
    return output


@pytest.mark.system
@pytest.mark.ros
def test_an_interface_package_installs_its_type_support(tmp_path: Path) -> None:
    prefix = tmp_path / "a prefix"
    for name in NAMES:
        cmake(AMENT / name, prefix)
    index = prefix / "share/ament_index/resource_index"
    assert (index / "rosidl_generator_packages/rosidl_generator_microros").is_file()
    generators = prefix / "share/rosidl_default_generators/cmake/rosidl_default_generatorsConfig.cmake"
    generators.parent.mkdir(parents=True)
    generators.write_text(ONLY_OURS)
    cmake(WORKSPACE / "base_interfaces", prefix, f"-DMICROROS_GEN_PYTHON={sys.executable}")
    library = (index / "rosidl_generator_microros/base_interfaces").read_text()
    assert (prefix / f"lib/lib{library}.a").is_file()
    assert (prefix / f"share/base_interfaces/cmake/{library}.cmake").is_file()
    assert (prefix / f"include/base_interfaces/{library}/base_interfaces/msg/wheel.h").is_file()


@pytest.mark.parametrize("name", NAMES)
def test_the_wheel_brings_what_a_workspace_would_install(name: str) -> None:
    """Its files, the index, and a configuration file that includes the same extras."""
    manifest = ElementTree.parse(AMENT / name / "package.xml")
    assert (manifest.findtext("name"), manifest.findtext("version")) == (name, __version__)
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    for path in ("package.xml", "cmake"):
        assert f'"cmake/ament/{name}/{path}" = "share/{name}/{path}"\n' in project
    prefix = AMENT / "prefix"
    index = prefix / "ament_index/resource_index"
    assert (index / "packages" / name).read_bytes() == b""
    needed = sorted(
        {str(element.text) for tag in ("buildtool_export_depend",) for element in manifest.iter(tag)}
    )
    assert (index / "package_run_dependencies" / name).read_text().split(";") == needed
    groups = [path.parent.name for path in index.glob(f"*_packages/{name}")]
    assert groups == [element.text for element in manifest.iter("member_of_group")]
    extras = re.findall(r"CONFIG_EXTRAS cmake/(\S+)\)", (AMENT / name / "CMakeLists.txt").read_text())
    assert [
        f'/{extra}")' in (prefix / name / f"cmake/{name}Config.cmake").read_text() for extra in extras
    ] == [True]


AGENT = AMENT / "microros_gen_agent"
PROGRAMS = ("agent", "micro_ros_agent")


def test_the_wheel_brings_the_agents_package() -> None:
    """Its files, executable, where `ros2 run` and `ros2 launch` look, and the entries of the index."""
    manifest = ElementTree.parse(AGENT / "package.xml")
    assert (manifest.findtext("name"), manifest.findtext("version")) == (AGENT.name, __version__)
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    for path, place in (
        ("package.xml", "share/microros_gen_agent/package.xml"),
        ("launch", "share/microros_gen_agent/launch"),
        ("programs", "lib/microros_gen_agent"),
    ):
        assert f'"cmake/ament/microros_gen_agent/{path}" = "{place}"\n' in project
    index = AMENT / "prefix/ament_index/resource_index"
    assert (index / "packages/microros_gen_agent").read_bytes() == b""
    needed = sorted(str(element.text) for element in manifest.iter("exec_depend"))
    assert (index / "package_run_dependencies/microros_gen_agent").read_text().split(";") == needed
    assert sorted(path.name for path in (AGENT / "programs").iterdir()) == sorted(PROGRAMS)


@pytest.mark.ros
def test_a_workspace_with_a_clone_runs_the_agent(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the path that `ros2 run` takes: the prefix of the index, lib, the package, the name of the program."""
    from ament_index_python import get_package_prefix, get_package_share_directory

    prefix = tmp_path / "a prefix"
    cmake(AGENT, prefix)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    folder = Path(get_package_prefix(AGENT.name)) / "lib" / AGENT.name
    assert (Path(get_package_share_directory(AGENT.name)) / "launch/agent.launch.py").is_file()
    for name in PROGRAMS:
        program = [str(folder / name), "upd4", "--port", "8888", "--ros-args"]
        environment = clean_environ(MICROROS_GEN_PYTHON=sys.executable)
        done = subprocess.run(program, env=environment, text=True, capture_output=True, check=False)
        assert done.returncode == 2
        assert "unknown transport 'upd4'. Did you mean 'udp4'?" in done.stderr
    monkeypatch.setenv("MICROROS_GEN_PYTHON", sys.executable)
    with running_agent(own_domain(), program=[str(folder / "agent")]) as agent:
        assert agent.stop() == 0


@dataclass(frozen=True)
class Action:
    """An action of a launch file, and what it was made with."""

    kind: str
    words: tuple[Any, ...]
    options: dict[str, Any]

    def perform(self, arguments: dict[str, str]) -> str:
        """Return the argument of the launch file that a LaunchConfiguration names."""
        return arguments[self.words[0]]


def of_kind(kind: str) -> Callable[..., Action]:
    return lambda *words, **options: Action(kind, words, options)


def test_the_launch_file_starts_the_agent_with_its_arguments(monkeypatch: pytest.MonkeyPatch) -> None:
    """With stand-ins for `launch` and `launch_ros`, of which there are no wheels."""
    for module, names in (
        ("launch", ("LaunchContext", "LaunchDescription")),
        ("launch.actions", ("DeclareLaunchArgument", "OpaqueFunction")),
        ("launch.substitutions", ("LaunchConfiguration",)),
        ("launch_ros", ()),
        ("launch_ros.actions", ("Node",)),
    ):
        stand_in = ModuleType(module)
        for name in names:
            setattr(stand_in, name, of_kind(name))
        monkeypatch.setitem(sys.modules, module, stand_in)
    file = runpy.run_path(str(AGENT / "launch/agent.launch.py"))
    (actions,) = file["generate_launch_description"]().words
    *declared, function = actions
    arguments = {action.words[0]: action.options["default_value"] for action in declared}
    (node,) = function.options["function"](arguments)
    assert (node.options["package"], node.options["executable"]) == (AGENT.name, "agent")
    assert node.options["arguments"] == ["udp4", "--port", "8888"]
    arguments["arguments"] = "--config '/etc/a file.yaml'"
    (node,) = function.options["function"](arguments)
    assert node.options["arguments"] == ["--config", "/etc/a file.yaml"]
    assert (node.options["respawn"], node.options["respawn_delay"]) == (True, 2.0)


@pytest.mark.ros
def test_rosidl_finds_the_generator(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the entry points of pyproject.toml, as an installation has them."""
    from rosidl_cli.command.generate.api import generate

    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    found = re.findall(r'entry-points\."(rosidl_cli\S+)"\]\n(\w+) = "(\S+)"', project)
    assert [group.rpartition(".")[2] for group, *_ in found] == ["type_extensions", "typesupport_extensions"]
    points = importlib.metadata.EntryPoints(
        importlib.metadata.EntryPoint(name, value, group) for group, name, value in found
    )
    monkeypatch.setattr(importlib.metadata, "entry_points", lambda: points)
    monkeypatch.chdir(WORKSPACE / "robot_interfaces")
    files = ["msg/Robot.msg", "msg/Battery.idl"]
    arguments = {"package_name": "robot_interfaces", "include_paths": [WORKSPACE], "interface_files": files}
    for chosen in ({"types": ["microros"]}, {"typesupports": ["microros[string: 8]"]}):
        (written,) = generate(**arguments, **chosen, output_path=tmp_path / "out")
        names = {path.relative_to(tmp_path / "out").as_posix() for path in written}
        assert {
            "include/robot_interfaces/msg/robot.h",
            "src/robot_interfaces/battery__type_support.c",
        } <= names
    (capacity,) = re.findall(
        r"char name\[(.*)\]", next((tmp_path / "out").rglob("robot__storage.h")).read_text()
    )
    assert capacity in ("9", "9U", "8U + 1U")


@pytest.mark.ros
def test_rosidl_prints_the_tools_diagnostics(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from microros_gen.cli.rosidl import Generator

    (tmp_path / "msg").mkdir()
    (tmp_path / "msg/Wrong.msg").write_text("int32 value\nother_msgs/Missing part\n")
    with pytest.raises(SystemExit) as end:
        Generator("microros").generate("mine", [f"{tmp_path}:msg/Wrong.msg"], [], tmp_path / "out")
    assert end.value.code == 2
    output = capsys.readouterr().err
    assert output.startswith(f"{tmp_path}/msg/Wrong.msg:2:1: error: unknown interface package 'other_msgs'")
    assert "Add -I and the folder of the package" in output
    with pytest.raises(SystemExit, match=r"cannot read the interface file 'msg/None\.msg'"):
        Generator("microros").generate("mine", ["msg/None.msg"], [], tmp_path / "out")
