# SPDX-License-Identifier: Apache-2.0
"""The two ament packages without colcon and without ROS's other generators: built from a clone, used by CMake alone.

What is in the run by default; the whole, with everything that ROS 2 generates next to it, is in test_colcon.py.
"""

from __future__ import annotations

import importlib.metadata
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

from microros_gen import __version__
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
    assert "-I adds a place" in output
    with pytest.raises(SystemExit, match=r"cannot read the interface file 'msg/None\.msg'"):
        Generator("microros").generate("mine", ["msg/None.msg"], [], tmp_path / "out")
