# SPDX-License-Identifier: Apache-2.0
"""The compiled core of the agent: what builds it, and that it passes the tests of the one in Python."""

from __future__ import annotations

import importlib
import inspect
import json
import os
import pkgutil
import shutil
import subprocess
import sys
import tempfile
import time
import typing
import zipfile
from collections.abc import Iterator
from dataclasses import is_dataclass, replace
from pathlib import Path
from typing import Any

import pytest

import hatch_build
import microros_gen.agent
import microros_gen.cli.agent
from microros_gen.agent.compiled import core_kind
from microros_gen.agent.monitoring.document import text_of
from microros_gen.agent.states import ClientState
from microros_gen.agent.workers.front_transport import FrontTransport
from microros_gen.agent.workers.report import Report
from microros_gen.cli.agent.status_table import status_table
from microros_gen.cli.agent.worker import WorkerStart
from microros_gen.diagnostics import Diagnostic, Span
from tests.support.agent.client import XrceClient, int32_body
from tests.support.agent.monitored import STATUS
from tests.support.agent.process import own_domain, running_agent
from tests.support.agent.ros_client import INT32
from tests.support.environments import clean_environ
from tests.support.installed import copy_of_sources
from tests.support.paths import ROOT
from tests.support.patience import deadline, seconds
from tests.support.sharing import shared_by_processes

SUITE = ("tests", "examples", "docs", "Makefile", ".clang-format")
"""What the tests read, besides the sources of the wheel."""
MODULES = (
    "test_arrivals",
    "test_bridge_topics",
    "test_bridge_wakeups",
    "test_budgets",
    "test_captured_dialogues",
    "test_core",
    "test_core_clients",
    "test_core_full",
    "test_core_reading",
    "test_core_services",
    "test_datagrams",
    "test_fair_edges",
    "test_fairness",
    "test_own_time",
    "test_policy",
    "test_server",
    "test_streams",
    "test_udp",
    "test_wire",
    "workers/test_front",
    "workers/test_report",
)
"""Tests of what is compiled, and of what uses it: recorded dialogues (the same bytes as the public agent's), streams,
turns, sockets, wake-ups by ROS 2, and what processes exchange."""


def test_this_checkout_runs_in_python() -> None:
    """Compiled modules beside the sources would hide changes of the sources."""
    assert core_kind() == "python"
    assert not list((ROOT / "microros_gen").rglob("*.so"))


def test_each_module_of_the_core_exists() -> None:
    for name in hatch_build.CORE:
        assert (ROOT / hatch_build.PACKAGE / f"{name}.py").is_file(), name


def _core() -> set[str]:
    return {f"{hatch_build.PACKAGE}/{name}".replace("/", ".") for name in hatch_build.CORE}


def test_no_class_outside_of_the_core_inherits_from_one_of_it() -> None:
    """Python would refuse to define it: "interpreted classes cannot inherit from compiled"."""
    core = _core()
    seen = set()
    for package in (microros_gen.agent, microros_gen.cli.agent):
        for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            for name, each in inspect.getmembers(importlib.import_module(found.name), inspect.isclass):
                bases = {base.__module__ for base in each.__mro__[1:]}
                if bases & core:
                    seen.add(name)
                    assert each.__module__ in core, f"{each.__module__}.{name}"
    assert {"WorkerUdp", "RawReader"} <= seen


def _data_classes(hint: object) -> Iterator[type]:
    """Return the data classes of a type: itself, those of its fields, and so on."""
    for part in typing.get_args(hint):
        yield from _data_classes(part)
    if isinstance(hint, type) and is_dataclass(hint):
        yield hint
        for field in typing.get_type_hints(hint).values():
            yield from _data_classes(field)


@pytest.mark.parametrize(
    ("root", "within"), [(Report, ClientState), (WorkerStart, FrontTransport), (Diagnostic, Span)]
)
def test_what_processes_exchange_is_outside_of_the_core(root: type, within: type) -> None:
    """A compiled data class that is frozen cannot be read from a pickle: its fields cannot be set."""
    exchanged = set(_data_classes(root))
    assert within in exchanged
    assert not {each.__qualname__ for each in exchanged if each.__module__ in _core()}


@pytest.mark.parametrize(("value", "wanted"), [(None, False), ("", False), ("0", False), ("1", True)])
def test_only_who_asks_gets_it(value: str | None, wanted: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(hatch_build.VARIABLE, raising=False)
    if value is not None:
        monkeypatch.setenv(hatch_build.VARIABLE, value)
    assert hatch_build.is_wanted("wheel", "standard") is wanted
    assert not hatch_build.is_wanted("wheel", "editable")
    assert not hatch_build.is_wanted("sdist", "standard")


def test_sources_that_cannot_be_compiled_are_no_wheel(tmp_path: Path) -> None:
    source = tmp_path / "source"
    (source / "microros_gen").mkdir(parents=True)
    (tmp_path / "work").mkdir()
    with pytest.raises(SystemExit, match=f"^{hatch_build.VARIABLE}: the agent's core cannot be compiled:\n"):
        hatch_build.compile_core(source, tmp_path / "work")


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder that the hook makes its temporary folder in."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setenv(hatch_build.VARIABLE, "1")
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def _hook(root: Path) -> hatch_build.CompiledCore:
    nothing: Any = None
    return hatch_build.CompiledCore(str(root), {}, nothing, nothing, "", "wheel")


@pytest.mark.parametrize("failure", [SystemExit("a fault"), KeyboardInterrupt()])
def test_a_build_that_fails_leaves_nothing(
    failure: BaseException, tmp_path: Path, temporary: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def compile_core(root: Path, folder: Path) -> dict[str, Path]:
        (folder / "part").touch()
        assert [folder] == list(temporary.iterdir())
        raise failure

    monkeypatch.setattr(hatch_build, "compile_core", compile_core)
    with pytest.raises(type(failure)):
        _hook(tmp_path).initialize("standard", {})
    assert not list(temporary.iterdir())


def test_what_was_built_is_removed_after_packing(
    tmp_path: Path, temporary: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hatch_build, "compile_core", lambda root, folder: {"a.so": folder / "a.so"})
    data: dict[str, Any] = {"force_include": {}}
    hook = _hook(tmp_path)
    hook.initialize("standard", data)
    (folder,) = temporary.iterdir()
    assert data["force_include"] == {str(folder / "a.so"): "a.so"}
    hook.finalize("standard", data, "")
    assert not list(temporary.iterdir())


def test_packing_that_fails_leaves_nothing(temporary: Path) -> None:
    program = """\
import hatch_build
hatch_build.compile_core = lambda root, folder: {"a.so": folder / "a.so"}
hatch_build.CompiledCore(".", {}, None, None, "", "wheel").initialize("standard", {"force_include": {}})
import os, tempfile
assert os.listdir(tempfile.gettempdir())
raise OSError("no space is left")
"""
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=ROOT,
        env={**os.environ, "TMPDIR": str(temporary)},
        capture_output=True,
        text=True,
        timeout=seconds(30),
        check=False,
    )
    assert "OSError: no space is left" in done.stderr
    assert not list(temporary.iterdir())


def _compiled(tree: Path) -> Path:
    """Make `tree` a copy of the checkout with the extension modules of a wheel; return it."""
    source, out = tree / "source", tree / "out"
    tree.mkdir(exist_ok=True)
    copy_of_sources(source)
    done = subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(out)],
        cwd=source,
        env=clean_environ(MICROROS_GEN_COMPILED="1", PATH=os.environ["PATH"], TMPDIR=str(tree), CFLAGS="-O0"),
        capture_output=True,
        text=True,
        timeout=seconds(300),
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert not list(tree.glob(f"{hatch_build.FOLDER}*"))
    (wheel,) = out.glob("*.whl")
    assert "-none-any" not in wheel.name
    for name in SUITE:
        path = ROOT / name
        if path.is_dir():
            shutil.copytree(path, tree / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(path, tree / name)
    shutil.copytree(source, tree, dirs_exist_ok=True)
    with zipfile.ZipFile(wheel) as opened:
        libraries = [name for name in opened.namelist() if name.endswith(".so")]
        opened.extractall(tree, libraries)
    assert len(libraries) == len(hatch_build.CORE) + 2  # what all modules share, and quick_calls.c
    return tree


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return shared_by_processes(tmp_path_factory, "compiled-core", _compiled)


@pytest.mark.system
def test_it_passes_the_tests_of_the_core_in_python(tree: Path, tmp_path: Path) -> None:
    kind = "from microros_gen.agent.compiled import core_kind; print(core_kind())"
    answer = subprocess.run(
        [sys.executable, "-c", kind], cwd=tree, capture_output=True, text=True, check=True
    )
    assert answer.stdout == "compiled\n"
    modules = [f"tests/agent/{name}.py" for name in MODULES]
    # Without a separate folder, pytest would delete what earlier runs of the whole suite have left: for minutes.
    options = ("-m", "not long and not system and not variant", "--basetemp", str(tmp_path / "inner"))
    tested = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", *options, *modules],
        cwd=tree,
        capture_output=True,
        text=True,
        timeout=seconds(300),
        check=False,
    )
    assert tested.returncode == 0, tested.stdout + tested.stderr


@pytest.mark.ros
@pytest.mark.system
def test_it_serves_in_several_processes(tree: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Clients over UDP in two workers, whose reports the status has."""
    monkeypatch.chdir(tree)
    place = tmp_path / "status"
    with running_agent(own_domain(), "--workers", "2", "--status-socket", str(place)) as agent:
        for key in (2, 3):
            with XrceClient(agent.port, key=key) as client:
                assert client.connect() == 0
                writer = client.publisher(f"node{key}", f"numbers{key}", INT32, own_domain())
                client.write(writer, int32_body(1))
                client.drain()
        shown, end = "", deadline(15)
        while not all(f"/node{key}" in shown for key in (2, 3)):
            assert time.monotonic() < end, shown
            command = [sys.executable, "-m", "microros_gen", "agent", "status", "--socket", str(place)]
            shown = subprocess.run(
                command, capture_output=True, text=True, check=True, timeout=seconds(30)
            ).stdout
        assert ", compiled core)" in shown
        assert [line.split()[-1] for line in shown.splitlines() if "/node" in line] == ["1", "2"]


@pytest.mark.parametrize(("core", "shown"), [("python", False), ("compiled", True)])
def test_the_status_says_which_core_runs(core: str, shown: bool) -> None:
    document = json.loads(text_of(replace(STATUS, core=core)))
    assert document["agent"]["core"] == core
    assert (", compiled core)" in status_table(document)) is shown
