# SPDX-License-Identifier: Apache-2.0
"""`microros-gen doctor` on machines with and without things; what it fixes."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from importlib import metadata
from pathlib import Path
from typing import Any

import pytest

from microros_gen.cli.doctor import ros, tools
from microros_gen.cli.doctor.finding import State, install
from microros_gen.cli.doctor.ros import colcon_findings
from microros_gen.cli.doctor.wheels import faulty_files, fix_files
from microros_gen.package.find import builtin_packages
from microros_gen.package.render import describe
from microros_gen.platform.find import builtin_targets
from tests.support.command_line import Outcome, Runner
from tests.support.environments import clean_environ
from tests.support.paths import ROOT
from tests.support.patience import seconds

FOREIGN = "/opt/python/cp312-cp312"
EXPORT = (
    "set_target_properties(a::b PROPERTIES\n"
    f'  INTERFACE_INCLUDE_DIRECTORIES "{FOREIGN}/include/python3.12;'
    f'{FOREIGN}/lib/python3.12/site-packages/numpy/_core/include;${{_IMPORT_PREFIX}}/include/a"\n)\n'
)
"""As the export files of rosidl_generator_py in the wheels name the build machine."""
GENERATORS = "share/rosidl_default_generators/package.xml"


def findings(outcome: Outcome) -> dict[str, dict[str, Any]]:
    return {f["name"]: f for f in json.loads(outcome.out)["findings"]}


def programs(folder: Path, **scripts: str) -> Path:
    """Make a folder with programs, each a shell script."""
    folder.mkdir(exist_ok=True)
    for name, text in scripts.items():
        (folder / name.replace("_", "-")).write_text(f"#!/bin/sh\n{text}\n")
        (folder / name.replace("_", "-")).chmod(0o755)
    return folder


def test_without_any_program(run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each tool chain, emulator and build program is missing once, with what needs it and what installs it."""
    monkeypatch.setenv("PATH", str(programs(folder / "empty")))
    outcome = run("doctor", *builtin_targets(), "cmake", "--format", "json")
    assert outcome.status == 1
    found = findings(outcome)
    assert {f["state"] for f in found.values()} == {"missing"}
    packages = {name: f["remedy"].split()[-1] for name, f in found.items()}
    assert packages["avr-gcc"] == "avr-libc"
    assert packages["arm-none-eabi-gcc"] == "libnewlib-arm-none-eabi"
    assert packages["riscv64-unknown-elf-gcc"] == "picolibc-riscv64-unknown-elf"
    assert packages["qemu-system-arm"] == "qemu-system-arm"
    assert packages["cmake"] == "cmake"
    assert packages["ninja or make"] == "ninja-build"
    assert any("host" in f["needed_for"] for f in found.values())
    covered = " ".join(f["needed_for"] for f in found.values())
    assert "cortex-m0plus, cortex-m3, cortex-m33 and" in covered


TOOLS = {
    "arduino": {"arduino_cli": "", "arduino_builder": ""},
    "platformio": {"platformio": ""},
    "esp-idf": {"idf.py": "", "IDF_PATH": ""},
    "zephyr": {"west": "", "cmake": "", "ninja": "", "dtc": ""},
    "stm32cube": {"arm_none_eabi_gcc": "", "cmake": ""},
    "pico": {"arm_none_eabi_gcc": "", "cmake": "", "PICO_SDK_PATH": ""},
    "teensy": {"arduino": ""},
    "nuttx": {"make": "", "kconfig_conf": ""},
}
"""What is enough for each package; in capitals: a folder that a variable names."""


def test_every_package_says_what_it_needs() -> None:
    """That of CMake is the way `cmake`."""
    assert {*TOOLS, "cmake"} == set(builtin_packages())
    assert all(describe(name).tools for name in TOOLS)


@pytest.mark.parametrize("package", TOOLS)
def test_what_a_package_needs(
    run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch, package: str
) -> None:
    """Nothing of it is there, then all; each missing thing has a remedy."""
    scripts = {name: text for name, text in TOOLS[package].items() if not name.isupper()}
    variables = set(TOOLS[package]) - set(scripts)
    for name in variables:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("PATH", str(programs(folder / "empty")))
    outcome = run("doctor", package, "--format", "json")
    assert outcome.status == 1
    for finding in findings(outcome).values():
        assert finding["state"] == "missing"
        assert finding["remedy"]
        assert finding["needed_for"] == f"build with the package {package}"
    monkeypatch.setenv("PATH", str(programs(folder / "bin", **scripts)))
    for name in variables:
        monkeypatch.setenv(name, str(folder))
    outcome = run("doctor", package, "--format", "json")
    assert outcome.status == 0, outcome.out


def test_a_variable_that_names_no_folder(run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PICO_SDK_PATH", str(folder / "gone"))
    outcome = run("doctor", "pico")
    assert outcome.status == 1
    assert outcome.out.splitlines()[:2] == [
        "broken   PICO_SDK_PATH      build with the package pico",
        f"         {folder}/gone is no folder",
    ]


def test_packages_are_looked_for_when_they_are_named(run: Runner) -> None:
    assert "package" not in run("doctor", "cmake").out
    unknown = run("doctor", "zephir")
    assert "Did you mean 'zephyr'?" in unknown.err


@pytest.mark.builds
def test_a_compiler_that_works(run: Runner, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    outcome = run("doctor", "host", "--format", "json")
    (found,) = findings(outcome).values()
    assert outcome.status == 0, outcome.out
    assert found["state"] == "ok"
    assert shutil.which(found["detail"]) == found["detail"]
    assert run("doctor", "host").out.splitlines()[-1] == "all 1 are there"


@pytest.mark.parametrize(
    ("target", "compiler", "archiver", "message"),
    [
        (
            "cortex-m4",
            "arm_none_eabi_gcc",
            "arm_none_eabi_ar",
            "fatal error: cannot read spec file 'nano.specs'",
        ),
        ("host", "cc", "ar", "<stdin>:1:10: fatal error: stdint.h: No such file or directory"),
    ],
)
def test_a_compiler_without_its_library(
    run: Runner,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    target: str,
    compiler: str,
    archiver: str,
    message: str,
) -> None:
    """It is on the PATH, and refuses a small program."""
    scripts = {compiler: f'echo noise >&2; echo "{message}" >&2; exit 1', archiver: "exit 0"}
    monkeypatch.setenv("PATH", str(programs(folder / "bin", **scripts)))
    outcome = run("doctor", target)
    assert outcome.status == 1
    lines = outcome.out.splitlines()
    assert lines[0].startswith("broken   ")
    assert lines[1] == f"         {folder}/bin/{compiler.replace('_', '-')}: {message}"
    assert "gcc" in lines[2]
    assert lines[-1] == "1 of 1 missing or broken"


def test_the_flags_of_the_target_reach_the_compiler(
    run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record = folder / "record"
    bin_folder = programs(folder / "bin", avr_gcc=f'echo "$@" > "{record}"', avr_ar="exit 0")
    monkeypatch.setenv("PATH", str(bin_folder))
    assert run("doctor", "atmega328p").status == 0
    assert "-mmcu=atmega328p" in record.read_text()


@pytest.mark.parametrize(("version", "state"), [("3.15.9", "broken"), ("3.16.0", "ok"), ("4.1.2", "ok")])
def test_the_version_of_cmake(
    run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch, version: str, state: str
) -> None:
    scripts = {"cmake": f"echo cmake version {version}", "ninja": "exit 0"}
    monkeypatch.setenv("PATH", str(programs(folder / "bin", **scripts)))
    outcome = run("doctor", "cmake", "--format", "json")
    assert findings(outcome)["cmake"]["state"] == state
    assert outcome.status == int(state != "ok")


def test_the_least_version_of_cmake_is_that_of_new_projects() -> None:
    template = (ROOT / "microros_gen/templates/init/CMakeLists.txt.j2").read_text(encoding="utf-8")
    match = re.search(r"cmake_minimum_required\(VERSION (\d+)\.(\d+)\)", template)
    assert match
    assert tuple(map(int, match.groups())) == tools.CMAKE


def test_an_unknown_way_gets_the_nearest(run: Runner) -> None:
    outcome = run("doctor", "colcn")
    assert outcome.status == 2
    assert "unknown way to build or run 'colcn'. Did you mean 'colcon'? [MG-9241]" in outcome.err


def test_other_systems_get_the_names_of_debian(tmp_path: Path) -> None:
    assert install(("a", "b"), tmp_path / "none") == "install what Debian calls a b"
    (tmp_path / "debian_version").touch()
    assert install(("a", "b"), tmp_path / "debian_version") == "apt-get install a b"


@pytest.mark.builds
def test_an_environment_without_ros(tmp_path: Path) -> None:
    """Where no rclpy can be imported, the remedy is the command of pip."""
    kept = sysconfig.get_path("purelib")
    code = (
        "import sys, importlib.abc\n"
        "class Gone(importlib.abc.MetaPathFinder):\n"
        "    def find_spec(self, name, path, target=None):\n"
        "        if name == 'rclpy':\n"
        "            raise ModuleNotFoundError(\"No module named 'rclpy'\", name='rclpy')\n"
        "sys.meta_path.insert(0, Gone())\n"
    )
    (tmp_path / "sitecustomize.py").write_text(code)
    path = os.pathsep.join([str(tmp_path), str(ROOT), kept])
    done = subprocess.run(
        [sys.executable, "-m", "microros_gen", "doctor", "agent", "--format", "json"],
        env=clean_environ(PYTHONPATH=path, XDG_CACHE_HOME=str(tmp_path)),
        capture_output=True,
        text=True,
        timeout=seconds(60),
        check=False,
    )
    assert done.returncode == 1, done.stderr
    (found,) = json.loads(done.stdout)["findings"]
    assert (found["name"], found["state"]) == ("rclpy", "missing")
    assert found["remedy"].startswith("pip install ros-jazzy-rclpy ")


@pytest.mark.ros
def test_ros_of_this_environment(run: Runner, monkeypatch: pytest.MonkeyPatch) -> None:
    assert findings(run("doctor", "agent", "--format", "json"))["rclpy"]["state"] == "ok"
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_other_cpp")
    outcome = run("doctor", "agent")
    assert outcome.status == 1
    assert "RMW_IMPLEMENTATION chooses rmw_other_cpp" in outcome.out


def required() -> list[str]:
    """Return the extra `colcon` of pyproject.toml (Python 3.10 has no reader of TOML)."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    match = re.search(r"^colcon = \[\n(.*?)^\]$", text, re.MULTILINE | re.DOTALL)
    assert match
    return re.findall(r'"([^"]+)"', match[1])


class Machine:
    """A Python environment in a folder; `installed` are its distributions with their versions."""

    def __init__(self, prefix: Path, patch: pytest.MonkeyPatch) -> None:
        self.prefix = prefix
        self.installed = {name.partition("==")[0]: name.partition("==")[2] or "1" for name in required()}
        (prefix / "bin").mkdir(parents=True)
        self.environ = {"PATH": str(prefix / "bin"), "AMENT_PREFIX_PATH": str(prefix)}
        programs(prefix / "bin", cmake="echo cmake version 3.25.1", make="exit 0", colcon="exit 0")
        (prefix / "share/ament_cmake_microros").mkdir(parents=True)
        (prefix / "share/ament_cmake_microros/package.xml").touch()
        patch.setattr(metadata, "requires", lambda name: [f"{r} ; extra == 'colcon'" for r in required()])
        patch.setattr(metadata, "version", self._version)

    def _version(self, name: str) -> str:
        if name not in self.installed:
            raise metadata.PackageNotFoundError(name)
        return self.installed[name]

    def export_file(self, package: str) -> Path:
        path = self.prefix / f"share/{package}/cmake/export_{package}__rosidl_generator_pyExport.cmake"
        path.parent.mkdir(parents=True)
        path.write_text(EXPORT)
        return path

    def bad(self) -> dict[str, str]:
        """Return what is not in order, and its remedy."""
        found = colcon_findings(self.environ, self.prefix)
        return {f.name: f.remedy for f in found if f.state is not State.OK}


@pytest.fixture
def machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Machine:
    return Machine(tmp_path / "environment", monkeypatch)


def test_an_environment_for_colcon_in_order(machine: Machine) -> None:
    assert machine.bad() == {}


def test_what_an_environment_for_colcon_can_lack(machine: Machine) -> None:
    del machine.installed["catkin_pkg"]
    machine.installed["empy"] = "4.2"
    (machine.prefix / "bin/colcon").unlink()
    (machine.prefix / "share/ament_cmake_microros/package.xml").unlink()
    machine.environ["AMENT_PREFIX_PATH"] = ""
    machine.export_file("a")
    bad = machine.bad()
    assert bad["ROS 2 wheels"] == "pip install catkin_pkg empy==3.3.4"
    assert bad["colcon"] == "pip install colcon-common-extensions"
    assert bad["AMENT_PREFIX_PATH"] == f'export AMENT_PREFIX_PATH="{machine.prefix}"'
    assert bad["CMake files of the wheels"] == "microros-gen doctor colcon --fix"
    assert "ament_cmake_microros" in bad
    assert len(bad) == 5


def test_colcon_outside_of_the_path(machine: Machine) -> None:
    machine.environ["PATH"] = os.pathsep.join(str(p) for p in (machine.prefix / "other",))
    programs(machine.prefix / "other", cmake="echo cmake version 3.25.1", make="exit 0")
    assert machine.bad() == {"colcon": f". {machine.prefix}/bin/activate"}


def test_with_a_sourced_ros_no_wheels_are_needed(machine: Machine, tmp_path: Path) -> None:
    machine.installed.clear()
    machine.export_file("a")
    (tmp_path / "opt/share/rosidl_default_generators").mkdir(parents=True)
    (tmp_path / "opt" / GENERATORS).touch()
    machine.environ["AMENT_PREFIX_PATH"] = str(tmp_path / "opt")
    assert machine.bad() == {}


def test_a_tool_without_metadata(machine: Machine, monkeypatch: pytest.MonkeyPatch) -> None:
    def gone(name: str) -> list[str]:
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "requires", gone)
    assert "ROS 2" in machine.bad()


def test_fixing(machine: Machine, run: Runner, monkeypatch: pytest.MonkeyPatch) -> None:
    """The files name this machine afterwards, keep the rest, and are not touched again."""
    export = machine.export_file("a")
    other = machine.prefix / "share/b/cmake/bExport.cmake"
    other.parent.mkdir(parents=True)
    other.write_text(EXPORT)
    assert faulty_files(machine.prefix) == (export,)
    monkeypatch.setattr(sys, "prefix", str(machine.prefix))
    for name, value in machine.environ.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr("microros_gen.cli.doctor.wheels._numpy_headers", lambda: "/n/numpy/include")
    outcome = run("doctor", "colcon", "--fix")
    assert outcome.status == 0, outcome.out
    text = export.read_text()
    python = sysconfig.get_path("include")
    assert text == EXPORT.replace(f"{FOREIGN}/include/python3.12", python).replace(
        f"{FOREIGN}/lib/python3.12/site-packages/numpy/_core/include", "/n/numpy/include"
    )
    assert other.read_text() == EXPORT
    assert fix_files(machine.prefix) == 0
    before = export.stat().st_mtime_ns
    assert run("doctor", "colcon", "--fix").status == 0
    assert export.stat().st_mtime_ns == before


def test_the_headers_of_numpy(machine: Machine) -> None:
    pytest.importorskip("numpy")
    export = machine.export_file("a")
    assert fix_files(machine.prefix) == 1
    folders = re.findall(r'(?<=["; ])/[^;"]*(?=[;"])', export.read_text())
    assert len(folders) == 2
    assert (Path(folders[0]) / "Python.h").is_file()
    assert (Path(folders[1]) / "numpy/arrayobject.h").is_file()


def test_every_requirement_of_the_extra_is_understood() -> None:
    for requirement in required():
        match = ros._REQUIREMENT.match(f"{requirement}; extra == 'colcon'")
        assert match, requirement
        assert match[1] + (f"=={match[2]}" if match[2] else "") == requirement
