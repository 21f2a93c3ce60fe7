# SPDX-License-Identifier: Apache-2.0
"""Which checks of the port a self-test has: those of the functions that the library has, in a fixed order."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from microros_gen.client.plan.project import Project
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Check:
    """A function of selftest_checks.h, the capabilities that it calls, and the further files that it needs."""

    name: str
    needs: tuple[str, ...]
    files: tuple[str, ...] = ()


_POOL = ("selftest_pool.c", "selftest_pool.h")
_LENGTHS = ("selftest_lengths.c", "selftest_lengths.h")
_LINK = ("selftest_link.c", "selftest_link.h")
CHECKS = (
    Check("steady", ("steady",)),
    Check("epoch", ("epoch",)),
    Check("microseconds", ("microseconds",)),
    Check("sleep", ("sleep",)),
    Check("wait", ("wait", "wake")),
    Check("timer", ("timer",)),
    Check("timer_wake", ("timer", "wait", "wake")),
    Check("lock", ("lock",)),
    Check("tasks", ("tasks",), _POOL),
    Check("task_wake", ("tasks", "wait", "wake"), _POOL),
    Check("exclusion", ("tasks", "lock"), _POOL),
    Check("inheritance", ("tasks", "lock"), _POOL),
    Check("stack_peak", ("stack_peak",)),
    Check("unique_id", ("unique_id",)),
    Check("udp", ("udp",)),
    Check("udp_loop", ("udp", "udp_local"), _LENGTHS),
    Check("udp_link", ("udp",), _LINK),
    Check("tcp", ("tcp",)),
    Check("tcp_link", ("tcp",), _LINK),
    Check("multicast", ("multicast",)),
    Check("serial", ("serial",), _LENGTHS),
    Check("serial_link", ("serial",), _LINK),
    Check("canfd", ("canfd",), _LENGTHS),
    Check("canfd_link", ("canfd",), _LINK),
    Check("storage", ("storage",)),
)


@dataclass(frozen=True)
class Skipped:
    """A check that the self-test lacks, and why."""

    name: str
    why: str


def uses(project: Project, capability: str) -> bool:
    """Return whether the library calls the functions of a capability."""
    return any(row.capability.name == capability for row in project.provisions.rows)


def chosen_checks(project: Project) -> tuple[tuple[Check, ...], tuple[Skipped, ...]]:
    """Return the checks of the functions that the library of `project` has, and the others."""
    chosen, skipped = [], []
    for check in CHECKS:
        missing = [name for name in check.needs if not uses(project, name)]
        if missing:
            skipped.append(Skipped(check.name, f"the library does not use {_listed(missing)}"))
        else:
            chosen.append(check)
    return tuple(chosen), tuple(skipped)


def files_of(checks: Iterable[Check]) -> Collection[str]:
    """Return the C files that the checks are in, and those that they need."""
    return {name for check in checks for name in (f"selftest_{check.name}.c", *check.files)}


def _listed(names: list[str]) -> str:
    return " and ".join(f"'{name}'" for name in names)
