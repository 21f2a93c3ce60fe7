# SPDX-License-Identifier: Apache-2.0
"""The wheel holds everything, and works where there is no repository and no ROS."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
import zipfile
from dataclasses import dataclass
from pathlib import Path

import pytest
from cli.environments import ROOT, clean_environ, install, with_dependencies

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
# What the wheel is made from, and what a fresh clone has; folders that git does not know are not in it.
SOURCES = ("pyproject.toml", "README.md", "LICENSE", "microros_gen", "profiles", "cmake")
DATA = ("profiles", "components", "templates", "idl", "targets")


@dataclass(frozen=True)
class Installed:
    """The wheel, and an environment that has it."""

    wheel: Path
    program: Path

    def run(self, *arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
        command = [str(self.program), *arguments]
        environment = clean_environ(XDG_CACHE_HOME=str(folder / "cache"))
        return subprocess.run(
            command, cwd=folder, env=environment, text=True, capture_output=True, check=False
        )


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Installed:
    base = tmp_path_factory.mktemp("package")
    source = base / "clone"
    source.mkdir()
    for name in SOURCES:
        path = ROOT / name
        if path.is_dir():
            shutil.copytree(path, source / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(path, source / name)
    wheel = [sys.executable, "-m", "pip", "wheel", "-q", "--disable-pip-version-check", "--no-deps"]
    made = subprocess.run([*wheel, "-w", str(base), str(source)], text=True, capture_output=True, check=False)
    assert made.returncode == 0, made.stdout + made.stderr
    (path,) = base.glob("microros_gen-*.whl")
    shutil.rmtree(source)
    _new_environment(base / "environment")
    subprocess.run(install(base / "environment", ["--no-deps", str(path)]), env=clean_environ(), check=True)
    return Installed(path, base / "environment" / "bin" / "microros-gen")


def _new_environment(folder: Path) -> None:
    """Make an environment that sees the packages of the kept one with the dependencies, and nothing else."""
    kept = with_dependencies(sys.executable, sys.version_info[:2])
    where = "import sysconfig; print(sysconfig.get_path('purelib'))"
    packages = subprocess.run([str(kept), "-c", where], text=True, capture_output=True, check=True).stdout
    subprocess.run(
        [sys.executable, "-m", "venv", "--without-pip", str(folder)], env=clean_environ(), check=True
    )
    (own,) = folder.glob("lib/python3*/site-packages")
    (own / "dependencies.pth").write_text(packages)


def test_the_wheel_holds_every_file_of_data(installed: Installed) -> None:
    with zipfile.ZipFile(installed.wheel) as wheel:
        there = set(wheel.namelist())
    for folder in DATA:
        origin = ROOT / "profiles" if folder == "profiles" else ROOT / "microros_gen" / folder
        files = [p.relative_to(origin).as_posix() for p in origin.rglob("*") if p.is_file()]
        assert files, folder
        assert {f"microros_gen/{folder}/{name}" for name in files} <= there
    for name in ("application.schema.json", "profile.schema.json", "msg.lark"):
        assert f"microros_gen/parse/{name}" in there
    assert not [name for name in there if name.startswith(("tests/", "examples/", "docs/"))]
    assert any(name.endswith("licenses/LICENSE") for name in there)


def test_it_builds_from_another_folder_without_ros(installed: Installed, tmp_path: Path) -> None:
    done = installed.run("build", "--profile", "pure_sender", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "build/pure_sender/lib/libmicroros.a").is_file()
    assert (tmp_path / "build/pure_sender/bin/pure_sender").is_file()
    golden = ["check", "--profile", "pure_sender", "--golden", str(ROOT / "tests/golden/pure_sender")]
    compared = installed.run(*golden, folder=tmp_path)
    assert compared.returncode == 0, compared.stdout[:2000] + compared.stderr


def test_cmake_finds_it_where_its_program_is_on_the_path(installed: Installed, tmp_path: Path) -> None:
    text = "cmake_minimum_required(VERSION 3.16)\nproject(found NONE)\nfind_package(microros_gen REQUIRED)\n"
    (tmp_path / "CMakeLists.txt").write_text(text + "microros_add_library(robot PROFILES pure_sendr)\n")
    environment = clean_environ(PATH=f"{installed.program.parent}{os.pathsep}{os.environ['PATH']}")
    configure = ["cmake", "-S", ".", "-B", "build"]
    done = subprocess.run(
        configure, cwd=tmp_path, env=environment, text=True, capture_output=True, check=False
    )
    assert "there is no profile 'pure_sendr'" in done.stderr
    cache = (tmp_path / "build/CMakeCache.txt").read_text()
    assert f"MICROROS_GEN_PROGRAM:FILEPATH={installed.program}\n" in cache


@pytest.mark.long
def test_an_editable_installation_has_the_files_of_cmake(tmp_path: Path) -> None:
    _new_environment(tmp_path / "environment")
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


def test_the_agent_says_what_it_needs(installed: Installed, tmp_path: Path) -> None:
    done = installed.run("agent", "udp4", "--port", "0", folder=tmp_path)
    assert done.returncode == 2
    assert "rclpy" in done.stderr
    assert "pip install 'microros-gen[ros]'" in done.stderr
    assert "Traceback" not in done.stderr


def test_help_starts_fast(installed: Installed, tmp_path: Path) -> None:
    """It imports nothing that a command needs; the time is bounded generously, for a busy machine."""
    times = []
    for _ in range(5):
        begin = time.perf_counter()
        installed.run("--help", folder=tmp_path)
        times.append(time.perf_counter() - begin)
    assert min(times) < 0.5
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
