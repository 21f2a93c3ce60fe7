# SPDX-License-Identifier: Apache-2.0
"""`check`: the users' comparison with their own golden copy."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from microros_gen.cli import main as cli
from microros_gen.interfaces.find import shipped_folder
from tests.support.command_line import Outcome, Runner

A_SOURCE = "src/std_msgs/int32__functions.c"


def check_arguments(golden: Path) -> list[str]:
    """Return the call that compares a golden copy of the smallest profile."""
    return [
        "check",
        "--profile",
        "pure_sender",
        "--interface-path",
        str(shipped_folder()),
        "--golden",
        str(golden),
    ]


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A golden copy, written once."""
    golden = tmp_path_factory.mktemp("golden") / "pure_sender"
    with pytest.raises(SystemExit) as end:
        cli.main([*check_arguments(golden), "--update"])
    assert end.value.code == 0
    return golden


def test_a_golden_copy_holds_sources_only(written: Path) -> None:
    assert {path.name for path in written.iterdir()} == {
        "CMakeLists.txt", "README.md", "examples", "include", "manifest.json", "microros_image.cmake",
        "sources.txt", "src",
    }  # fmt: skip


@pytest.fixture
def copy(folder: Path, written: Path) -> Path:
    """A golden copy of the test's own, in the current folder."""
    shutil.copytree(written, folder / "golden" / "pure_sender")
    return folder / "golden" / "pure_sender"


def check(run: Runner, *more: str) -> Outcome:
    return run(*check_arguments(Path("golden/pure_sender")), *more)


def test_a_changed_file_is_shown_as_a_unified_diff(run: Runner, copy: Path) -> None:
    path = copy / A_SOURCE
    path.write_text(path.read_text().replace("return false;", "return true;", 1))
    outcome = check(run)
    assert outcome.status == 1
    lines = outcome.out.splitlines()
    assert lines[:2] == [f"--- golden/{A_SOURCE}", f"+++ generated/{A_SOURCE}"]
    assert lines[2].startswith("@@ -")
    assert "-    return true;" in lines
    assert "+    return false;" in lines
    assert "1 of" in outcome.err


def test_a_missing_file_is_shown_as_added(run: Runner, copy: Path) -> None:
    (copy / A_SOURCE).unlink()
    outcome = check(run)
    assert outcome.status == 1
    assert outcome.out.splitlines()[:2] == ["--- /dev/null", f"+++ generated/{A_SOURCE}"]


def test_a_surplus_file_is_shown_as_removed(run: Runner, copy: Path) -> None:
    (copy / "src" / "surplus.c").write_text("int surplus;\n")
    outcome = check(run)
    assert outcome.status == 1
    assert outcome.out.splitlines() == [
        "--- golden/src/surplus.c",
        "+++ /dev/null",
        "@@ -1 +0,0 @@",
        "-int surplus;",
    ]


def test_all_differences_are_reported_in_one_run(run: Runner, copy: Path) -> None:
    (copy / "README.md").write_text("")
    (copy / "sources.txt").unlink()
    (copy / "new.c").write_text("\n")
    outcome = check(run)
    assert outcome.status == 1
    assert [line[4:] for line in outcome.out.splitlines() if line.startswith("--- ")] == [
        "golden/README.md", "golden/new.c", "/dev/null",
    ]  # fmt: skip


def test_check_changes_nothing(run: Runner, copy: Path) -> None:
    (copy / "new.c").write_text("\n")
    before = {p: p.stat().st_mtime_ns for p in copy.rglob("*")}
    assert check(run).status == 1
    assert {p: p.stat().st_mtime_ns for p in copy.rglob("*")} == before


def test_line_ends_are_differences(run: Runner, copy: Path) -> None:
    path = copy / A_SOURCE
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    outcome = check(run)
    assert outcome.status == 1
    assert A_SOURCE in outcome.out


def test_the_generators_version_is_left_out(run: Runner, copy: Path) -> None:
    path = copy / "manifest.json"
    manifest = json.loads(path.read_text())
    manifest["generator"]["version"] = "0.0.0.another"
    path.write_text(json.dumps(manifest))
    assert check(run).status == 0
    manifest["plan"] = "0" * 16
    path.write_text(json.dumps(manifest))
    assert check(run).status == 1


def test_what_a_build_adds_is_left_out(run: Runner, copy: Path) -> None:
    for name in ("lib/libmicroros.a", "bin/pure_sender", ".build/src/a.o"):
        (copy / name).parent.mkdir(parents=True)
        (copy / name).write_bytes(b"\0")
    assert check(run).status == 0


def test_update_rewrites_what_differs_and_no_more(run: Runner, copy: Path, written: Path) -> None:
    kept = copy / "sources.txt"
    before = kept.stat().st_mtime_ns
    (copy / A_SOURCE).write_text("")
    (copy / "README.md").unlink()
    updated = check(run, "--update")
    assert updated.status == 0
    assert "2 written" in updated.out
    assert kept.stat().st_mtime_ns == before
    assert check(run).status == 0
    held = {p.relative_to(copy) for p in copy.rglob("*")}
    assert held == {p.relative_to(written) for p in written.rglob("*")}


def test_update_writes_a_copy_where_none_is(run: Runner, folder: Path) -> None:
    assert check(run).status == 2
    assert check(run, "--update").status == 0
    assert check(run).status == 0


def test_update_removes_what_is_no_longer_generated(run: Runner, copy: Path) -> None:
    arguments = ("--interface", "std_msgs/msg/Empty")
    assert check(run, *arguments).status == 1
    assert check(run, *arguments, "--update").status == 0
    assert (copy / "src/std_msgs/empty__functions.c").is_file()
    assert "removed" in check(run, "--update").out
    assert not (copy / "src/std_msgs/empty__functions.c").exists()
    assert check(run).status == 0


def test_a_golden_copy_that_is_missing_says_how_to_make_it(run: Runner, folder: Path) -> None:
    outcome = run("check", "--profile", "pure_sender", "--golden", "nowhere")
    assert outcome.status == 2
    assert "--update" in outcome.err


def test_a_folder_of_others_is_not_overwritten(run: Runner, folder: Path) -> None:
    (folder / "golden" / "pure_sender").mkdir(parents=True)
    (folder / "golden" / "pure_sender" / "thesis.txt").write_text("mine")
    outcome = check(run, "--update")
    assert outcome.status == 2
    assert [p.name for p in (folder / "golden" / "pure_sender").iterdir()] == ["thesis.txt"]
