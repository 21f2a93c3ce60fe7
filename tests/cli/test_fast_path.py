# SPDX-License-Identifier: Apache-2.0
"""A run of `generate` with nothing changed ends early, and with anything changed it does not."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

import microros_gen
from microros_gen.compiler import api, request
from microros_gen.interfaces.find import shipped_folder
from microros_gen.output import runs
from tests.support.command_line import Outcome, Runner

pytestmark = pytest.mark.builds

APPLICATION = """\
version: 1
profiles: [pure_sender]
interfaces: [own_msgs]
limits: {"*": {string: 8}}
"""
OUT = Path("build/pure_sender")
COUNT_SOURCE = OUT / "src/own_msgs/count__type_support.c"
OLD = time.time_ns() - 3_600_000_000_000


def put(path: Path, text: str) -> None:
    """Write a file that claims to be an hour old, as `cp -p`, tar and rsync do."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    os.utime(path, ns=(OLD, OLD))


def age(folder: Path) -> None:
    for path in (folder, *folder.rglob("*")):
        os.utime(path, ns=(OLD, OLD))


@pytest.fixture
def application(folder: Path) -> Path:
    put(folder / "microros.yaml", APPLICATION)
    put(folder / "interfaces" / "own_msgs" / "msg" / "Count.msg", "int32 value\n")
    put(folder / "later" / "other_msgs" / "msg" / "Other.msg", "int8 value\n")
    age(folder / "interfaces")
    age(folder / "later")
    return folder


@pytest.fixture
def generate(run: Runner) -> Runner:
    def call(*arguments: str) -> Outcome:
        time.sleep(0.03)  # what is as young as the run is never trusted
        outcome = run("generate", "--interface-path", "interfaces", "--interface-path", "later", *arguments)
        assert outcome.status == 0, outcome.err
        return outcome

    return call


@pytest.fixture
def settled(application: Path, generate: Runner, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The application was generated, and a second run came from the record. Returns a log of full runs."""
    log: list[str] = []
    original = request.read_request

    def logged(*arguments: object) -> object:
        log.append("full run")
        return original(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(api, "read_request", logged)
    generate()
    generate()
    assert log == ["full run"]
    log.clear()
    return log


def test_a_fast_run_says_what_a_full_run_says(
    application: Path, generate: Runner, settled: list[str]
) -> None:
    fast = generate()
    assert settled == []
    shutil.rmtree(os.environ["XDG_CACHE_HOME"])
    full = generate()
    assert settled == ["full run"]
    assert fast == full
    assert "0 written" in fast.out


def test_a_fast_run_repeats_the_warnings(run: Runner, folder: Path) -> None:
    put(
        folder / "microros.yaml",
        "version: 1\nprofiles: [pure_sender]\nnodes:\n  - name: n\n    publishers:\n"
        "      - {topic: t, type: std_msgs/msg/Int32}\npools: {publishers: 4}\n",
    )
    outcomes = [run("generate") for _ in range(3)]
    assert "pools" in outcomes[0].err
    assert outcomes[1].err == outcomes[2].err == outcomes[0].err


def test_a_changed_application_file(application: Path, generate: Runner, settled: list[str]) -> None:
    put(application / "microros.yaml", APPLICATION + "errors: code\n")
    generate()
    assert settled
    assert (application / OUT / "src/support/error_code.c").is_file()


def test_an_application_file_of_the_same_size(
    application: Path, generate: Runner, settled: list[str]
) -> None:
    (application / "microros.yaml").write_text(APPLICATION.replace("8", "9"))
    generate()
    assert settled


def test_an_application_file_that_is_deleted_and_created(run: Runner, folder: Path) -> None:
    assert run("generate", "--profile", "pure_sender").status == 0
    time.sleep(0.03)
    assert run("generate", "--profile", "pure_sender").status == 0
    put(folder / "microros.yaml", "version: 1\nerrors: code\n")
    assert run("generate", "--profile", "pure_sender").status == 0
    assert (folder / OUT / "src/support/error_code.c").is_file()
    (folder / "microros.yaml").unlink()
    assert run("generate", "--profile", "pure_sender").status == 0
    assert (folder / OUT / "src/support/error_text.c").is_file()


def test_a_changed_interface(application: Path, generate: Runner, settled: list[str]) -> None:
    put(application / "interfaces/own_msgs/msg/Count.msg", "int64 value\n")
    generate()
    assert "cdr_put_8" in (application / COUNT_SOURCE).read_text()


def test_a_new_interface_of_a_requested_package(
    application: Path, generate: Runner, settled: list[str]
) -> None:
    put(application / "interfaces/own_msgs/msg/Extra.msg", "bool value\n")
    generate()
    assert (application / OUT / "src/own_msgs/extra__type_support.c").is_file()


def test_a_removed_interface_of_a_requested_package(
    application: Path, generate: Runner, settled: list[str]
) -> None:
    put(application / "interfaces/own_msgs/msg/Extra.msg", "bool value\n")
    generate()
    (application / "interfaces/own_msgs/msg/Extra.msg").unlink()
    generate()
    assert not (application / OUT / "src/own_msgs/extra__type_support.c").exists()


@pytest.mark.parametrize("change", ["changed", "deleted"])
def test_an_output_file(application: Path, generate: Runner, settled: list[str], change: str) -> None:
    before = (application / COUNT_SOURCE).read_bytes()
    if change == "changed":
        (application / COUNT_SOURCE).write_bytes(before.replace(b"4U", b"5U"))
    else:
        (application / COUNT_SOURCE).unlink()
    assert "1 written" in generate().out
    assert (application / COUNT_SOURCE).read_bytes() == before


def test_an_interrupted_run_of_another_selection(
    application: Path, generate: Runner, settled: list[str]
) -> None:
    """Its journal lies there, and a file that no one needs."""
    stray = "src/std_msgs/empty__functions.c"
    text = "/* half of another selection */\n"
    put(application / OUT / stray, text)
    journal = {
        "files": {stray: [hashlib.sha256(text.encode()).hexdigest()]},
        "generator": {"name": "microros-gen"},
    }
    put(application / OUT / ".microros-gen-journal.json", json.dumps(journal))
    generate()
    assert not (application / OUT / stray).exists()
    assert not (application / OUT / ".microros-gen-journal.json").exists()


def test_a_package_that_appears_at_an_earlier_place(
    application: Path, generate: Runner, settled: list[str]
) -> None:
    put(application / "microros.yaml", APPLICATION.replace("own_msgs", "other_msgs"))
    generate()
    assert "cdr_put_1" in (application / OUT / "src/other_msgs/other__type_support.c").read_text()
    put(application / "interfaces/other_msgs/msg/Other.msg", "int64 value\n")
    generate()
    assert "cdr_put_8" in (application / OUT / "src/other_msgs/other__type_support.c").read_text()


def test_a_folder_that_becomes_a_package_at_an_earlier_place(
    application: Path, generate: Runner, settled: list[str]
) -> None:
    """The folder was there already, so the change is not seen in the folder above it."""
    (application / "interfaces" / "other").mkdir()
    age(application / "interfaces")
    put(application / "microros.yaml", APPLICATION.replace("own_msgs", "other_msgs"))
    generate()
    generate()
    put(application / "interfaces/other/package.xml", "<package><name>other_msgs</name></package>")
    put(application / "interfaces/other/msg/Other.msg", "int64 value\n")
    generate()
    assert "cdr_put_8" in (application / OUT / "src/other_msgs/other__type_support.c").read_text()


def test_another_ament_prefix_path(
    application: Path, generate: Runner, settled: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    put(application / "microros.yaml", APPLICATION.replace("own_msgs", "std_msgs/msg/Int32"))
    generate()
    put(application / "prefix/share/std_msgs/msg/Int32.msg", "int64 data\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(application / "prefix"))
    generate()
    assert "cdr_put_8" in (application / OUT / "src/std_msgs/int32__type_support.c").read_text()
    monkeypatch.delenv("AMENT_PREFIX_PATH")
    generate()
    assert "cdr_put_4" in (application / OUT / "src/std_msgs/int32__type_support.c").read_text()


def test_a_package_that_appears_in_the_ament_prefix(
    application: Path, generate: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(application / "microros.yaml", APPLICATION.replace("own_msgs", "std_msgs/msg/Int32"))
    (application / "prefix/share/std_msgs").mkdir(parents=True)
    age(application / "prefix")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(application / "prefix"))
    generate()
    generate()
    put(application / "prefix/share/std_msgs/msg/Int32.msg", "int64 data\n")
    generate()
    assert "cdr_put_8" in (application / OUT / "src/std_msgs/int32__type_support.c").read_text()


def test_a_users_profile_and_what_it_extends(application: Path, generate: Runner, settled: list[str]) -> None:
    put(application / "base.yaml", "profile: base\nsummary: s\nextends: [pure_sender]\n")
    put(application / "top.yaml", "profile: top\nsummary: s\nextends: [base]\n")
    put(application / "microros.yaml", APPLICATION.replace("[pure_sender]", "[top]"))
    assert "build/top" in generate().out
    generate()
    settled.clear()
    put(application / "base.yaml", "profile: base\nsummary: s\nextends: [pure_sender]\nliveliness: none\n")
    generate()
    assert settled
    assert not (application / "build/top/src/ping").exists()


def test_a_file_that_changed_while_it_was_read(
    application: Path, generate: Runner, settled: list[str]
) -> None:
    """Its new state must not pass for the one that was read."""
    ahead = time.time_ns() + 1_000_000_000
    path = application / "interfaces/own_msgs/msg/Count.msg"
    os.utime(path, ns=(ahead, ahead))
    generate()
    generate()
    assert settled == ["full run"] * 2


def test_the_tools_own_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "microros_gen"
    for name in (
        "components/cdr/src/a.c",
        "templates/a.j2",
        "targets/host.yaml",
        "cli/main.py",
        "__init__.py",
    ):
        put(package / name, "1")
    put(tmp_path / "profiles" / "pure_sender.yaml", "1")
    monkeypatch.setattr(microros_gen, "__file__", str(package / "__init__.py"))
    states = {runs._tool_state()}
    files = sorted(p for p in tmp_path.rglob("*") if p.is_file())
    assert len(files) == 6
    for count, path in enumerate(files, 2):
        path.write_text("2")
        states.add(runs._tool_state())
        assert len(states) == count, path
    assert runs._tool_state() in states


def test_a_new_version_of_a_package_that_renders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    packages = tmp_path / "lib" / "site-packages"
    packages.mkdir(parents=True)
    monkeypatch.setattr(sys, "path", [str(packages), *sys.path])
    before = runs._tool_state()
    age(packages)
    assert runs._tool_state() != before


@pytest.mark.parametrize("record", ["", "{", "[]", '{"tool": 1}'])
def test_a_spoilt_record_is_no_error(
    application: Path, generate: Runner, settled: list[str], record: str
) -> None:
    for path in Path(os.environ["XDG_CACHE_HOME"]).rglob("*.json"):
        path.write_text(record)
    generate()
    assert settled == ["full run"]


def test_a_cache_that_cannot_be_written_is_no_error(
    application: Path, generate: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(application / "file", "")
    monkeypatch.setenv("XDG_CACHE_HOME", str(application / "file"))
    generate()
    assert "0 written" in generate().out


def test_it_imports_nothing_that_a_full_run_needs(folder: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": str(Path(microros_gen.__file__).parents[1])}
    call = [sys.executable, "-X", "importtime", "-m", "microros_gen", "generate", "--profile", "pure_sender"]
    call += ["--interface-path", str(shipped_folder())]
    for _ in range(2):
        result = subprocess.run(call, env=environment, text=True, capture_output=True, check=True)
    imported = {line.rsplit("|", 1)[-1].strip() for line in result.stderr.splitlines()}
    assert "microros_gen.output.runs" in imported
    assert not imported & {
        "jinja2",
        "yaml",
        "lark",
        "jsonschema",
        "microros_gen.compiler.api",
        "microros_gen.compiler.pipeline",
        "microros_gen.compiler.request",
    }
