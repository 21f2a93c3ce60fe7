# SPDX-License-Identifier: Apache-2.0
"""The wheel holds everything, and works without a repository and without ROS."""

from __future__ import annotations

import os
import re
import subprocess
import time
import zipfile
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from microros_gen.package.render import describe, plan_package, render_package
from microros_gen.ros.libraries import INSTALL
from tests.support.environments import clean_environ, install
from tests.support.installed import Installed, environment_with_dependencies
from tests.support.paths import ROOT
from tests.support.patience import seconds

pytestmark = pytest.mark.system
COMMANDS = (
    "build",
    "generate",
    "check",
    "resolve",
    "profiles",
    "interfaces",
    "targets",
    "run",
    "agent",
    "agent udp4",
)
DATA = ("profiles", "components", "templates", "idl", "targets", "platform")


def test_the_wheel_holds_every_file_of_data(installed: Installed) -> None:
    with zipfile.ZipFile(installed.wheel) as wheel:
        names = set(wheel.namelist())
    for folder in DATA:
        origin = ROOT / "profiles" if folder == "profiles" else ROOT / "microros_gen" / folder
        files = [
            p.relative_to(origin).as_posix()
            for p in origin.rglob("*")
            if p.is_file() and "__pycache__" not in p.parts
        ]
        assert files, folder
        assert {f"microros_gen/{folder}/{name}" for name in files} <= names
    shared = {name.partition(".data/data/share/")[2] for name in names}
    assert "cmake/microros_gen/microros_genConfig.cmake" in shared
    prefix = ROOT / "cmake" / "ament" / "prefix"
    ament = {path.relative_to(prefix).as_posix() for path in prefix.glob("*/cmake/*.cmake")}
    assert ament | {name.replace("Config.", "-extras.") for name in ament} <= shared
    for name in (
        "application/application.schema.json",
        "selection/profile.schema.json",
        "interfaces/msg/msg.lark",
        "package/package.schema.json",
        "LICENSE",
    ):
        assert f"microros_gen/{name}" in names
    assert not [name for name in names if name.startswith(("tests/", "examples/", "docs/"))]
    assert any(name.endswith("licenses/LICENSE") for name in names)


def test_it_builds_from_another_folder_without_ros(installed: Installed, tmp_path: Path) -> None:
    done = installed.run("build", "--profile", "pure_sender", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "build/pure_sender/lib/libmicroros.a").is_file()
    assert (tmp_path / "build/pure_sender/bin/pure_sender").is_file()
    golden = tmp_path / "golden"
    options = compiler.Options(profiles=("pure_sender",), interface_paths=(shipped_folder(),))
    compiler.generate(options, golden)  # by this checkout
    compared = installed.run("check", "--profile", "pure_sender", "--golden", str(golden), folder=tmp_path)
    assert compared.returncode == 0, compared.stdout[:2000] + compared.stderr


def test_it_makes_a_package_from_another_folder(installed: Installed, tmp_path: Path) -> None:
    done = installed.run("package", "cmake", "-o", "out", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    files = render_package(plan_package(describe("cmake"), None, (shipped_folder(),)))  # by this checkout
    assert (tmp_path / "out/manifest.json").read_bytes() == files["manifest.json"]
    assert (tmp_path / "out/LICENSE").read_bytes() == (ROOT / "LICENSE").read_bytes()


def test_cmake_finds_it_where_its_program_is_on_the_path(installed: Installed, tmp_path: Path) -> None:
    text = "cmake_minimum_required(VERSION 3.16)\nproject(found NONE)\nfind_package(microros_gen REQUIRED)\n"
    (tmp_path / "CMakeLists.txt").write_text(text + "microros_add_library(robot PROFILES pure_sendr)\n")
    environment = clean_environ(PATH=f"{installed.program.parent}{os.pathsep}{os.environ['PATH']}")
    configure = ["cmake", "-S", ".", "-B", "build"]
    done = subprocess.run(
        configure, cwd=tmp_path, env=environment, text=True, capture_output=True, check=False
    )
    assert "unknown profile 'pure_sendr'" in done.stderr
    cache = (tmp_path / "build/CMakeCache.txt").read_text()
    assert f"MICROROS_GEN_PROGRAM:FILEPATH={installed.program}\n" in cache


def test_its_ament_package_starts_its_agent(installed: Installed, tmp_path: Path) -> None:
    """Without the program in the PATH, as `ros2 run microros_gen_agent agent` starts it."""
    environment = installed.program.parents[1]
    assert (environment / "share/microros_gen_agent/launch/agent.launch.py").is_file()
    assert (environment / "share/ament_index/resource_index/packages/microros_gen_agent").is_file()
    for name in ("agent", "micro_ros_agent"):
        program = environment / "lib/microros_gen_agent" / name
        done = subprocess.run(
            [program, "upd4"], cwd=tmp_path, env=clean_environ(), text=True, capture_output=True, check=False
        )
        assert "unknown transport 'upd4'" in done.stderr


@pytest.mark.long
def test_an_editable_installation_has_the_files_of_cmake(tmp_path: Path) -> None:
    environment_with_dependencies(tmp_path / "environment")
    options = ["--no-deps", "--editable", str(ROOT)]
    subprocess.run(install(tmp_path / "environment", options), env=clean_environ(), check=True)
    installed = tmp_path / "environment/share/cmake/microros_gen"
    files = {path.name: path.read_bytes() for path in installed.iterdir()}
    assert files == {path.name: path.read_bytes() for path in (ROOT / "cmake").glob("*.cmake")}


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_help_works_without_ros(installed: Installed, tmp_path: Path, command: str) -> None:
    done = installed.run(*command.split(), "--help", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(f"Usage: microros-gen {command}".rstrip())
    assert done.stderr == ""


def test_what_the_agent_asks_for_is_the_extra_of_the_package() -> None:
    (extra,) = re.findall(r"(?m)^ros = \[(.*)\]$", (ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert INSTALL.split()[2:] == re.findall(r'"([^"]+)"', extra)


def test_the_agent_says_what_it_needs(installed: Installed, tmp_path: Path) -> None:
    done = installed.run("agent", "udp4", "--port", "0", folder=tmp_path)
    assert done.returncode == 2
    assert "rclpy" in done.stderr
    assert INSTALL in done.stderr
    assert "Traceback" not in done.stderr


def test_help_starts_fast(installed: Installed, tmp_path: Path) -> None:
    """It imports nothing that a command needs; the time is bounded generously, for a busy machine."""
    times = []
    for _ in range(5):
        begin = time.perf_counter()
        installed.run("--help", folder=tmp_path)
        times.append(time.perf_counter() - begin)
    assert min(times) < seconds(0.25)
    python = str(installed.program.parent / "python")
    call = [python, "-X", "importtime", "-m", "microros_gen", "--help"]
    done = subprocess.run(call, cwd=tmp_path, env=clean_environ(), text=True, capture_output=True, check=True)
    imported = {line.rsplit("|", 1)[-1].strip() for line in done.stderr.splitlines()}
    assert "click" in imported
    assert not imported & {
        "jinja2",
        "yaml",
        "lark",
        "jsonschema",
        "rclpy",
        "asyncio",
        "microros_gen.cli.build",
    }


def test_the_version_is_the_wheels(installed: Installed, tmp_path: Path) -> None:
    done = installed.run("--version", folder=tmp_path)
    assert installed.wheel.name.split("-")[1] in done.stdout
