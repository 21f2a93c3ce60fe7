# SPDX-License-Identifier: Apache-2.0
"""Time-outs scale with the machine's load, and no test has one of fixed seconds."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from tests.support import patience
from tests.support.paths import TESTS

LONG_RUNS = {"soak.py", "soak_client.py", "soak_peer.py"}
"""Their times are what they are about."""


@pytest.mark.parametrize(
    ("load", "running", "processors", "factor"),
    [(0.1, 1, 2, 2), (2.0, 1, 2, 2), (8.0, 1, 2, 8), (0.5, 12, 2, 12), (8.0, 8, 16, 2), (500.0, 1, 2, 20)],
)
def test_the_factor(load: float, running: int, processors: int, factor: float) -> None:
    assert patience.factor(load, running, processors) == factor


def test_a_busy_machine_is_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    monkeypatch.setattr("os.getloadavg", lambda: (9.0, 0.0, 0.0))
    assert patience.seconds(10) >= 90


def fixed_seconds(path: Path) -> list[str]:
    """Return the places where a call has a time-out of some seconds or more, as a number."""
    found = []
    text = path.read_text(encoding="utf-8")
    tree = ast.parse(text if "timeout" in text or "time.monotonic" in text else "")
    for node in ast.walk(tree):
        if isinstance(node, ast.keyword) and node.arg == "timeout":
            value: ast.expr = node.value
        elif isinstance(node, ast.BinOp) and ast.unparse(node.left) == "time.monotonic()":
            value = node.right
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith(".settimeout"):
            value = node.args[0]
        else:
            continue
        if isinstance(value, ast.Constant) and isinstance(value.value, (int, float)) and value.value >= 3:
            found.append(f"{path.name}:{value.lineno}")
    return sorted(found)


def test_no_test_has_a_time_out_of_fixed_seconds() -> None:
    paths = [p for p in sorted(TESTS.rglob("*.py")) if p.name not in LONG_RUNS and "bench" not in p.parts]
    assert [place for path in paths for place in fixed_seconds(path)] == []


def test_the_check_finds_fixed_seconds(tmp_path: Path) -> None:
    wrong = "run(timeout=60)\nend = time.monotonic() + 15\nlink.settimeout(5)\n"
    text = wrong + "link.settimeout(0.05)\nrun(timeout=seconds(9))\n"
    (tmp_path / "x.py").write_text(text)
    assert fixed_seconds(tmp_path / "x.py") == ["x.py:1", "x.py:2", "x.py:3"]
