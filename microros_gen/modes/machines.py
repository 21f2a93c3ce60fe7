# SPDX-License-Identifier: Apache-2.0
"""Parts as automata: where one ends for a command can depend on what it was before.

An unconfigured node that is commanded to be inactive stays unconfigured, because that counts as inactive
(`inference.fulfills`). A node that follows its commands is therefore an automaton with two states, unconfigured or
configured; those of a system are all combinations of those of its parts. States that nobody can tell apart are merged:
in most models one is left.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

from microros_gen.modes.model import Status
from microros_gen.modes.reports import Diagnosis
from microros_gen.records import dataclass

Failures = tuple[tuple[str, Status | Diagnosis], ...]
"""The nodes that are stuck, and where; and the statuses of nodes that are not OK."""

Seen = TypeVar("Seen")

Machine = tuple[tuple[tuple[Seen, ...], ...], tuple[tuple[int, ...], ...]]
"""By state and target, in the order of the targets: what is seen of the part then, and its state after that."""


@dataclass(frozen=True)
class Origin:
    """The fewest failures that an automaton takes, and for each of its states the nodes that are configured before."""

    failures: Failures
    configured: tuple[tuple[str, ...], ...] = ((),)


Behaviors = dict[Machine[Status], Origin]
"""What a part ends in."""


def constant(ends: tuple[Seen, ...]) -> Machine[Seen]:
    """Return an automaton with one state."""
    return (ends,), ((0,) * len(ends),)


def reduced(machine: Machine[Seen], origin: Origin) -> tuple[Machine[Seen], Origin]:
    """Return the automaton without states that cannot be told from others by any sequence of targets."""
    seen, after = machine
    if len(seen) == 1:
        return machine, origin
    classes = _numbered(seen)
    while True:
        finer = _numbered([(classes[i], *(classes[j] for j in row)) for i, row in enumerate(after)])
        if max(finer) == max(classes):
            break
        classes = finer
    if max(classes) + 1 == len(seen):
        return machine, origin
    chosen: dict[int, int] = {}
    for state in sorted(range(len(seen)), key=lambda i: len(origin.configured[i])):
        chosen.setdefault(classes[state], state)
    states = [chosen[i] for i in range(len(chosen))]
    return (
        tuple(seen[i] for i in states),
        tuple(tuple(classes[j] for j in after[i]) for i in states),
    ), Origin(origin.failures, tuple(origin.configured[i] for i in states))


def _numbered(rows: tuple[object, ...] | list[tuple[int, ...]]) -> list[int]:
    """Return a number for each row, from 0 in the order of their first occurrence; equal rows have one number."""
    numbers: dict[object, int] = {}
    return [numbers.setdefault(row, len(numbers)) for row in rows]


def product(
    before: tuple[Machine[Seen], Origin],
    own: tuple[Machine[Seen], Origin],
    join: Callable[[Seen, Seen], Seen],
) -> tuple[Machine[Seen], Origin]:
    """Return what two automata that get the same targets are together; `join` joins what is seen of them."""
    (seen_a, after_a), known = before
    (seen_b, after_b), added = own
    seen = tuple(tuple(map(join, a, b)) for a in seen_a for b in seen_b)
    failures = known.failures + added.failures
    if len(seen) == 1:
        return (seen, after_a), Origin(failures)
    count = len(seen_b)
    after = tuple(tuple(i * count + j for i, j in zip(a, b, strict=True)) for a in after_a for b in after_b)
    configured = tuple(a + b for a in known.configured for b in added.configured)
    return reduced((seen, after), Origin(failures, configured))


def size_of(machines: Mapping[Machine[Seen], Origin]) -> int:
    """Return how many states automata have together."""
    return sum(len(seen) for seen, _ in machines)
