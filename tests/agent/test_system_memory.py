# SPDX-License-Identifier: Apache-2.0
"""What the system leaves to the agent, and the warning that all of its processes together may take more."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.agent.configuration.model import PtyChoice
from microros_gen.agent.limits import Limits, limits_with
from microros_gen.agent.system_memory import system_bytes
from microros_gen.cli.agent import start
from microros_gen.cli.agent.assembly import FRONT_BYTES, memory_of_system
from microros_gen.cli.agent.options import AgentOptions
from tests.support.command_line import Runner

MIB = 1 << 20
EACH = Limits().memory_bytes


@pytest.mark.parametrize(
    ("service", "around", "machine", "expected"),
    [
        ("max", "max", "MemTotal:     1024 kB", MIB),
        ("1048575", "max", "MemTotal:     1024 kB", MIB - 1),
        ("max", "1048575", "MemTotal:     1024 kB", MIB - 1),
        ("1048577", "2097152", "MemTotal:     1024 kB", MIB),
        ("2097152", "max", "", 2 * MIB),
        ("max", "max", "", None),
    ],
)
def test_the_least_of_all_limits_counts(
    tmp_path: Path, service: str, around: str, machine: str, expected: int | None
) -> None:
    own = tmp_path / "own"
    own.write_text("4:memory:/elsewhere\n0::/system.slice/agent.service\n")
    group = tmp_path / "groups/system.slice/agent.service"
    group.mkdir(parents=True)
    (group / "memory.max").write_text(f"{service}\n")
    (group.parent / "memory.max").write_text(f"{around}\n")
    (tmp_path / "memory.max").write_text("1\n")
    info = tmp_path / "meminfo"
    info.write_text(f"{machine}\nMemFree:  1 kB\n")
    assert system_bytes(own, tmp_path / "groups", info) == expected


def test_a_system_that_says_nothing(tmp_path: Path) -> None:
    assert system_bytes(tmp_path / "a", tmp_path / "b", tmp_path / "c") is None


@pytest.mark.parametrize(
    ("workers", "available", "hint"),
    [
        (1, EACH, None),
        (1, EACH - 1, f"memory_bytes: {EACH - 1},"),
        (2, 2 * EACH + FRONT_BYTES, None),
        (2, 2 * EACH + FRONT_BYTES - 1, f"memory_bytes: {EACH - 1},"),
        (4, 512 * MIB, "Lower the pools"),
        (64, None, None),
    ],
)
def test_all_processes_together(workers: int, available: int | None, hint: str | None) -> None:
    """With the value of the hint there is no warning."""
    options = AgentOptions(transports=(PtyChoice(),), workers=workers)
    found = memory_of_system(options, available)
    assert (found is not None) == (hint is not None)
    if found is None or hint is None or available is None:
        return
    assert found.id == "MG-9873"
    assert hint in (found.hint or "")
    if "memory_bytes:" in hint:
        limits = limits_with({"memory_bytes": int(hint.rpartition(" ")[2].rstrip(","))})
        assert (
            memory_of_system(AgentOptions((PtyChoice(),), workers=workers, limits=limits), available) is None
        )


def test_a_check_warns(run: Runner, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(start, "system_bytes", lambda: 512 * MIB)
    result = run("agent", "pty", "--workers", "2", "--check")
    assert (result.status, result.out) == (0, "no faults\n")
    assert "MG-9873" in result.err
    assert "MG-9873" not in run("agent", "pty", "--check").err


@pytest.mark.parametrize("more", [(), ("--workers", "2")])
def test_a_check_adds_the_limits_up(run: Runner, more: tuple[str, ...]) -> None:
    """As the start does; status 2 as for a fault in a file."""
    result = run("agent", "pty", "--limit", f"object_bytes={128 * MIB}", *more, "--check")
    assert (result.status, result.out) == (2, "")
    assert "or set memory_bytes: 327155712 [MG-9708]" in result.err
    enough = ("--limit", "memory_bytes=327155712")
    assert run("agent", "pty", "--limit", f"object_bytes={128 * MIB}", *enough, *more, "--check").status == 0
