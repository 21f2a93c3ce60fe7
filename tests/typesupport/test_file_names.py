# SPDX-License-Identifier: Apache-2.0
"""No output has a file that Windows cannot have, or two that differ by case alone; types that would are reported."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.platform.find import builtin_targets
from microros_gen.selection.find_components import load_catalogue
from microros_gen.typesupport.plan.file_names import device_in, equal_but_for_case
from tests.support.command_line import Runner
from tests.support.golden import GOLDEN, HASHES, applications
from tests.support.paths import ROOT

SOURCES = ("microros_gen", "profiles", "cmake", "docs", "examples", "tests")


@pytest.mark.parametrize(
    ("path", "device"),
    [
        ("include/p/msg/con.h", "con.h"),
        ("src/AUX/a.c", "AUX"),
        ("src/p/nul__functions.c", None),
        ("nul", "nul"),
        ("a/com1.tar.gz", "com1.tar.gz"),
        ("a/com10.h", None),
        ("a/lpt9 .h", "lpt9 .h"),
        ("a/console.h", None),
        ("prn/b", "prn"),
    ],
)
def test_names_of_devices(path: str, device: str | None) -> None:
    assert device_in(path) == device


def test_names_that_differ_by_case() -> None:
    assert list(equal_but_for_case(["a/b.h", "a/B.h", "c"])) == [("a/B.h", "a/b.h")]
    assert list(equal_but_for_case(["A/x.h", "a/y.h"])) == [("A", "a")]
    assert list(equal_but_for_case(["a/x.h", "a/y.h", "a/x.h"])) == []


def test_no_golden_output_has_such_names() -> None:
    outputs: dict[str, list[str]] = {name: [] for name in applications()}
    for line in (GOLDEN / HASHES).read_text(encoding="utf-8").splitlines():
        path, _, names = line.partition(" ")[2].partition(": ")
        for name in names.split():
            outputs[name].append(path)
    for name, paths in outputs.items():
        own = [p.relative_to(GOLDEN / name).as_posix() for p in (GOLDEN / name).rglob("*")]
        assert paths, name
        assert [p for p in (*paths, *own) if device_in(p)] == []
        assert list(equal_but_for_case([*paths, *own])) == []


def test_an_output_with_every_included_type_has_no_such_names(tmp_path: Path) -> None:
    packages = sorted(p.name for p in (ROOT / "microros_gen/idl").iterdir() if p.is_dir())
    options = compiler.Options(components=("cdr",), interfaces=tuple(packages))
    paths = list(compiler.render(compiler.plan(compiler.resolve(compiler.read(options)))))
    assert len(paths) > 1000
    assert [p for p in paths if device_in(p)] == []
    assert list(equal_but_for_case(paths)) == []


def test_no_component_or_target_has_such_a_name() -> None:
    names = [*load_catalogue(), *builtin_targets()]
    files = [f"{c.folder.name}/{n}" for c in load_catalogue().values() for n in (*c.headers, *c.sources)]
    assert [n for n in (*names, *files) if device_in(n)] == []


def test_the_repository_can_be_cloned_on_windows() -> None:
    paths = [p.relative_to(ROOT).as_posix() for name in SOURCES for p in (ROOT / name).rglob("*")]
    assert [p for p in paths if device_in(p)] == []
    assert list(equal_but_for_case(paths)) == []


@pytest.mark.parametrize(
    ("package", "name", "file"),
    [("robot", "Con", "con.h"), ("robot", "LPT1", "lpt1.h"), ("aux", "Wheel", "aux")],
)
def test_a_type_whose_file_windows_cannot_have(
    run: Runner, folder: Path, package: str, name: str, file: str
) -> None:
    """A warning: elsewhere it works, and the type may be somebody else's. Names of fields do not matter."""
    (folder / package / "msg").mkdir(parents=True)
    (folder / package / "msg" / f"{name}.msg").write_text("int32 nul\n")
    arguments = ("--profile", "pure_sender", "--interface-path", package, "--interface", package)
    outcome = run("generate", *arguments, "-o", "out")
    assert outcome.status == 0
    first = outcome.err.splitlines()[0]
    assert first.startswith(
        f"{package}/msg/{name}.msg:1:1: warning: Windows cannot have the file '{file}' of"
    )
    assert first.endswith("[MG-9242]")
    assert outcome.err.count("warning") == 1


def test_usual_names_are_not_reported(run: Runner, folder: Path) -> None:
    (folder / "robot/msg").mkdir(parents=True)
    (folder / "robot/msg/Control.msg").write_text("int32 con\nint32 aux\n")
    outcome = run("generate", "--profile", "pure_sender", "--interface-path", "robot", "--interface", "robot")
    assert (outcome.status, outcome.err) == (0, "")
