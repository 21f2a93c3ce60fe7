# SPDX-License-Identifier: Apache-2.0
"""What a user gets wrong ends the configuration, in the tool's own words where they are its own; ways to be found."""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

import pytest

from microros_gen import __version__
from tests.support.environments import dependencies
from tests.support.paths import ROOT
from tests.support.workspace.projects import EXAMPLE, Project, run

BEGIN = "cmake_minimum_required(VERSION 3.16)\nproject(wrong NONE)\n"
FIND = "find_package(microros_gen REQUIRED)\n"


@pytest.fixture
def project(tmp_path: Path) -> Project:
    (tmp_path / "a project").mkdir()
    return Project(tmp_path / "a project")


def refused(project: Project, text: str, *options: str) -> str:
    """Configure `text`, which has to fail; return the messages, in one line without CMake's breaks."""
    (project.source / "CMakeLists.txt").write_text(BEGIN + text)
    done = project.configure(*options)
    assert done.returncode != 0, done.stdout
    return " ".join(done.stderr.split())


def test_what_the_tool_says_arrives_as_it_is(project: Project) -> None:
    wrong = project.source / "microros.yaml"
    wrong.write_text("version: 1\nprofiles: [pure_sendr]\nnoddes: []\n")
    (project.source / "CMakeLists.txt").write_text(BEGIN + FIND + "microros_add_library(robot)\n")
    done = project.configure()
    tool = run(
        *(sys.executable, "-m", "microros_gen", "generate", "-c", wrong),
        cwd=wrong.parent,
        env=project.environment,
    )
    assert (done.returncode, tool.returncode) == (1, 2)
    assert f"{wrong}:3:1: error: " in tool.stderr
    assert done.stderr.startswith(tool.stderr)
    assert "microros-gen refused the library 'robot' (status 2)" in done.stderr
    assert not project.out.exists()


def test_an_argument_that_it_does_not_have(project: Project) -> None:
    output = refused(project, FIND + "microros_add_library(robot PROFILE pure_sender)\n")
    assert (
        "microros_add_library(robot): 'PROFILE' is not one of its arguments. Available: CONFIG, TARGET"
        in output
    )


@pytest.mark.system
def test_sources_for_another_machine(project: Project) -> None:
    output = refused(project, FIND + "microros_add_library(robot PROFILES pure_sender TARGET cortex-m4)\n")
    assert "its target is a microcontroller, and this project compiles for this machine" in output
    add = "microros_add_library(robot PROFILES pure_sender)\n"
    text = (EXAMPLE / "qemu-mps2-an386.cmake").read_text(encoding="utf-8")
    toolchain = project.source / "vendor.cmake"  # with another name of the processor than the tool's
    toolchain.write_text(text.replace("CMAKE_SYSTEM_PROCESSOR qemu-mps2-an386", "CMAKE_SYSTEM_PROCESSOR arm"))
    output = refused(project, FIND + add, "--fresh", f"-DCMAKE_TOOLCHAIN_FILE={toolchain}")
    assert "and this project compiles for arm without one. Say which with TARGET" in output


@pytest.mark.skipif(shutil.which("arm-none-eabi-gcc") is None, reason="no arm-none-eabi-gcc")
def test_the_target_is_that_of_the_application_file_before_that_of_the_tool_chain(project: Project) -> None:
    """The tool-chain file's counts where nothing else names one: examples/cmake_app is built so."""
    config = project.source / "microros.yaml"
    config.write_text("version: 1\nprofiles: [pure_sender]\ntarget: cortex-m4f\n")
    text = BEGIN + FIND + "microros_add_library(robot)\n"
    (project.source / "CMakeLists.txt").write_text(text)
    done = project.configure(f"-DCMAKE_TOOLCHAIN_FILE={EXAMPLE / 'qemu-mps2-an386.cmake'}")
    assert done.returncode == 0, done.stderr
    assert "pure_sender for cortex-m4f: " in done.stdout


def test_a_python_without_the_dependencies(project: Project) -> None:
    bare = project.source / "python"
    bare.write_text(f'#!/bin/sh\nexec "{sys.executable}" -S "$@"\n')
    bare.chmod(0o755)
    output = refused(project, FIND, f"-DMICROROS_GEN_PYTHON={bare}")
    assert (
        f"MICROROS_GEN_PYTHON ({bare}) cannot run microros_gen: ModuleNotFoundError: No module named"
        in output
    )
    assert "-m pip install" in output


def test_every_dependency_is_looked_for() -> None:
    """The probe of microros_genConfig.cmake imports what pyproject.toml asks for."""
    config = (ROOT / "cmake" / "microros_genConfig.cmake").read_text(encoding="utf-8")
    (probed,) = re.findall(r'-c "import microros_gen, ([^"]*)"', config)
    modules = {"pyelftools": "elftools", "pyyaml": "yaml"}
    names = [re.split(r"[<>=~!\[ ]", wanted)[0].lower() for wanted in dependencies()]
    assert probed.split(", ") == sorted(modules.get(name, name) for name in names)


@pytest.mark.parametrize(
    ("version", "taken"),
    [("", True), ("0.1", True), (__version__, True), ("0.0.9", False), ("1", False), ("0.2", False)],
)
def test_the_version_is_the_tools(project: Project, version: str, taken: bool) -> None:
    found = "${microros_gen_FOUND} ${microros_gen_VERSION}."
    text = f'find_package(microros_gen {version})\nmessage(STATUS "{found}")\n'
    (project.source / "CMakeLists.txt").write_text(BEGIN + text)
    done = project.configure()
    assert done.returncode == 0, done.stderr
    assert (f"-- 1 {__version__}." if taken else "-- 0") in done.stdout


def test_a_part_of_a_larger_build_finds_it_without_find_package(project: Project) -> None:
    """FetchContent and add_subdirectory of the repository; one definition serves every folder of the project."""
    text = f"""\
include(FetchContent)
FetchContent_Declare(microros_gen SOURCE_DIR "{project.tool}")
FetchContent_MakeAvailable(microros_gen)
get_property(command GLOBAL PROPERTY MICROROS_GEN_COMMAND)
if(command AND COMMAND microros_add_library)
  message(FATAL_ERROR "there it is")
endif()
"""
    assert "there it is" in refused(project, text)
    text = f'add_subdirectory("{project.tool}" microros_gen)\nmicroros_add_library()\n'
    assert "microros_add_library" in refused(project, text, "--fresh")
