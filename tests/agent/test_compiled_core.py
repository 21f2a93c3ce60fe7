# SPDX-License-Identifier: Apache-2.0
"""The compiled core of the agent: what builds it, and that it passes the tests of the one in Python."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest

import hatch_build
from microros_gen.agent.compiled import core_kind
from microros_gen.agent.monitoring.document import text_of
from microros_gen.cli.agent.status_table import status_table
from tests.support.agent.monitored import STATUS
from tests.support.environments import clean_environ
from tests.support.installed import copy_of_sources
from tests.support.paths import ROOT
from tests.support.patience import seconds

SUITE = ("tests", "examples", "docs", "Makefile", ".clang-format")
"""What the tests read, besides the sources of the wheel."""
MODULES = (
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
)
"""Tests of what is compiled: recorded dialogues (the same bytes as the public agent's), streams, turns and sockets."""


def test_this_checkout_runs_in_python() -> None:
    """Compiled modules beside the sources would hide changes of the sources."""
    assert core_kind() == "python"
    assert not list((ROOT / "microros_gen").rglob("*.so"))


def test_each_module_of_the_core_exists() -> None:
    for name in hatch_build.CORE:
        assert (ROOT / hatch_build.PACKAGE / f"{name}.py").is_file(), name


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


@pytest.mark.system
def test_it_passes_the_tests_of_the_core_in_python(tmp_path: Path) -> None:
    """In a copy of the checkout, with the extension modules of a wheel."""
    source, out, tree = tmp_path / "source", tmp_path / "out", tmp_path / "tree"
    copy_of_sources(source)
    done = subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(out)],
        cwd=source,
        env=clean_environ(MICROROS_GEN_COMPILED="1", PATH=os.environ["PATH"]),
        capture_output=True,
        text=True,
        timeout=seconds(300),
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    (wheel,) = out.glob("*.whl")
    assert "-none-any" not in wheel.name
    for name in SUITE:
        path = ROOT / name
        if path.is_dir():
            shutil.copytree(path, tree / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            tree.mkdir(exist_ok=True)
            shutil.copy(path, tree / name)
    shutil.copytree(source, tree, dirs_exist_ok=True)
    with zipfile.ZipFile(wheel) as opened:
        libraries = [name for name in opened.namelist() if name.endswith(".so")]
        opened.extractall(tree, libraries)
    assert len(libraries) == len(hatch_build.CORE) + 1
    kind = "from microros_gen.agent.compiled import core_kind; print(core_kind())"
    answer = subprocess.run(
        [sys.executable, "-c", kind], cwd=tree, capture_output=True, text=True, check=True
    )
    assert answer.stdout == "compiled\n"
    modules = [f"tests/agent/{name}.py" for name in MODULES]
    tested = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-m", "not long and not system", *modules],
        cwd=tree,
        capture_output=True,
        text=True,
        timeout=seconds(300),
        check=False,
    )
    assert tested.returncode == 0, tested.stdout + tested.stderr


@pytest.mark.parametrize(("core", "shown"), [("python", False), ("compiled", True)])
def test_the_status_says_which_core_runs(core: str, shown: bool) -> None:
    document = json.loads(text_of(replace(STATUS, core=core)))
    assert document["agent"]["core"] == core
    assert (", compiled core)" in status_table(document)) is shown
