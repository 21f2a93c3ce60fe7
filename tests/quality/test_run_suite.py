# SPDX-License-Identifier: Apache-2.0
"""What `make test` leaves out runs in `make system` or `make lint`, and what it does in part runs there in full."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import chain, combinations
from pathlib import Path

import pytest
from _pytest.mark.expression import Expression

from tests.support.examples import EXAMPLES, LEAST, examples, some
from tests.support.paths import TESTS
from tests.support.runtime.harness import EVERYWHERE
from tests.tools.run_suite import RUNS, SANITIZED, Run, carry_out, command, compile_tests

FOLDERS = sorted(path.parent.name for path in TESTS.glob("*/__init__.py"))
MARKERS = ("ros", "builds", "lint", "system", "variant", "hypothesis", "examples")
SETS = [frozenset(chosen) for n in range(len(MARKERS) + 1) for chosen in combinations(MARKERS, n)]


compiled = cache(Expression.compile)


def has(run: Run, folder: str, markers: frozenset[str]) -> bool:
    """Return whether a run has the tests of a folder with these markers."""
    if folder in run.without or (run.folders and folder not in run.folders):
        return False

    def matches(name: str, /, **_: str | int | bool | None) -> bool:
        return name in markers

    return compiled(run.markers).evaluate(matches)


def runs(name: str, folder: str, markers: frozenset[str]) -> list[Run]:
    return [run for run in RUNS[name] if has(run, folder, markers)]


@pytest.mark.parametrize("folder", FOLDERS)
def test_every_test_that_is_not_long_runs(folder: str) -> None:
    """In CI, all but variants; a developer has these, too."""
    for names, left_out in (({"check", "lint"}, "variant"), ({"test", "system", "lint"}, "long")):
        missing = [markers for markers in SETS if not any(runs(name, folder, markers) for name in names)]
        assert all(left_out in markers for markers in missing)


@pytest.mark.builds
@pytest.mark.parametrize(
    ("again", "body", "status", "runs_of_it"),
    [
        (1, "assert runs == 2", 0, 2),  # a test that passes alone
        (1, "raise AssertionError", 1, 2),
        pytest.param(0, "assert runs == 2", 1, 1, marks=pytest.mark.variant),
        pytest.param(1, "pass", 0, 1, marks=pytest.mark.variant),
    ],
)
def test_what_failed_with_others_runs_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, again: int, body: str, status: int, runs_of_it: int
) -> None:
    count = tmp_path / "count"
    count.touch()
    # Without a separate folder, the runs would delete what earlier runs of the whole suite have left.
    monkeypatch.setenv("PYTEST_DEBUG_TEMPROOT", str(tmp_path))
    (tmp_path / "test_x.py").write_text(
        "from pathlib import Path\ndef test_x():\n"
        f"    count = Path({str(count)!r})\n    count.write_text(count.read_text() + 'x')\n"
        f"    runs = len(count.read_text())\n    {body}\n"
    )
    assert carry_out(Run("not long", again=again), ["-n", "1", str(tmp_path)], tmp_path) == status
    assert len(count.read_text()) == runs_of_it


@pytest.mark.builds
def test_a_test_that_hangs_fails_with_its_stack(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """And the tests after it run."""
    monkeypatch.setenv("PYTEST_DEBUG_TEMPROOT", str(tmp_path))
    (tmp_path / "test_x.py").write_text(
        "import threading\ndef test_a():\n    threading.Event().wait()\ndef test_b():\n    pass\n"
    )
    options = ("-n", "1", "-o", "faulthandler_timeout=1", str(tmp_path))
    assert carry_out(Run("not long"), options, tmp_path) == 1
    output = "".join(capfd.readouterr())
    assert "1 failed, 1 passed" in output
    assert 'test_x.py", line 3 in test_a' in output


@pytest.mark.parametrize("folder", FOLDERS)
def test_make_system_runs_no_test_twice(folder: str) -> None:
    assert [markers for markers in SETS if len(runs("system", folder, markers)) > 1] == []


def test_make_system_has_all_examples_and_all_sanitizers() -> None:
    assert all(run.environment == {EXAMPLES: "all", EVERYWHERE: "all"} for run in RUNS["system"])
    for marker in ("hypothesis", "examples"):
        assert all(runs("system", folder, frozenset({marker})) for folder in FOLDERS)
    assert all(runs("system", folder, frozenset()) for folder in SANITIZED)


def test_long_runs_are_in_no_target() -> None:
    for run in chain.from_iterable(RUNS.values()):
        assert not any(has(run, folder, markers | {"long"}) for folder in FOLDERS for markers in SETS)


def test_a_folder_that_another_run_has_is_left_out() -> None:
    call = command(Run("system", without=("runtime",)), ())
    assert "--ignore=tests/runtime" in call


def test_each_folder_of_a_fresh_clone_is_compiled_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folders = [tmp_path / name for name in "abc"]
    for folder in folders:
        folder.mkdir()
        (folder / "test_x.py").touch()
    collected: list[str] = []

    class Collecting:
        def __init__(self, call: Sequence[str], **_: object) -> None:
            collected.extend(word for word in call if word.startswith(str(tmp_path)))

        def wait(self) -> int:
            return 0

    monkeypatch.setattr("tests.tools.run_suite.TESTS", tmp_path)
    monkeypatch.setattr("tests.tools.run_suite.subprocess.Popen", Collecting)
    compile_tests()
    assert sorted(collected) == [str(folder) for folder in folders]
    collected.clear()
    (folders[0] / "__pycache__").mkdir()
    compile_tests()
    assert collected == []


@pytest.mark.parametrize(("full", "drawn"), [(1500, 300), (200, 40), (100, LEAST), (15, 15)])
def test_how_many_examples_are_drawn(monkeypatch: pytest.MonkeyPatch, full: int, drawn: int) -> None:
    monkeypatch.delenv(EXAMPLES, raising=False)
    assert examples(full) == drawn
    assert some(range(9)) == range(0, 9, 4)
    monkeypatch.setenv(EXAMPLES, "few")
    assert examples(full) == max(5, full // 30)
    monkeypatch.setenv(EXAMPLES, "all")
    assert examples(full) == full
    assert some(range(9)) == range(9)
