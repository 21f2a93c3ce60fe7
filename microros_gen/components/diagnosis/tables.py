# SPDX-License-Identifier: Apache-2.0
"""Statuses of a device with their counters and checks as C, and how large their messages can be."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from microros_gen.application.diagnosis_decl import CheckDecl, DiagnosisDecl
from microros_gen.application.model import Application, NodeDecl
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.records import dataclass
from microros_gen.typesupport.views.text import string

NO_CHECK = 255
MOST_STATUSES = 64
"""A bit says of each whether it is to be sent; those of 30 tasks and of the library take 40 at most."""
MOST_ROWS = 255
"""Positions of counters are bytes."""
_STAMP = 8
_LONGEST_NUMBER = 11
_COUNT = 4
_WORDS = len(" has changed")
_LIMIT = len(" above ") + _LONGEST_NUMBER
_STALE = len("not set, or too long ago")


@dataclass(frozen=True)
class CounterRow:
    """A counter of a status: `value` is its expression in C. `words`: the table of C whose entry is shown."""

    group: str
    key: str
    value: str
    warns: bool = False
    words: str = "NULL"
    header: str = ""

    @property
    def entry(self) -> str:
        """Return its row as C."""
        return f"{{{string(self.key)}, {self.words}, {'true' if self.warns else 'false'}}}"


@dataclass(frozen=True)
class CheckRow:
    """A check of a status. `value` is the expression in C of what is measured; empty: the application sets it."""

    group: str
    key: str
    warn: int | None
    error: int | None
    above: bool = True
    unit: str = ""
    node: int = 0
    hysteresis: int = 0
    timeout_ms: int = 0
    mode: str = ""
    status: int = 0
    value: str = ""

    @property
    def entry(self) -> str:
        """Return its row as C."""
        members = (
            string(self.key),
            string(self.unit) if self.unit else "NULL",
            string(self.mode) if self.mode else "NULL",
            f"{self.hysteresis}u",
            f"{self.timeout_ms}u",
            _int32(self.warn or 0),
            _int32(self.error or 0),
            *("true" if flag else "false" for flag in self._flags),
            f"{self.status}",
            f"{self.node}",
        )
        return f"{{{', '.join(members)}}}"

    @property
    def good(self) -> str:
        """Return the last value without a fault, as C."""
        return _int32(next(limit for limit in (self.warn, self.error, 0) if limit is not None))

    @property
    def _flags(self) -> tuple[bool, bool, bool]:
        return self.warn is not None, self.error is not None, self.above

    def measured(self, index: int) -> tuple[str, ...]:
        """Return the statement that sets it at position `index`; none: the application does."""
        return (f"rcl_diagnosis_note({index}, {self.value});",) if self.value else ()


def _int32(number: int) -> str:
    """Return a constant of C. INT32_C has no lowest number: a minus is an operator."""
    return f"INT32_C({number})" if number > -(1 << 31) else "INT32_MIN"


@dataclass(frozen=True)
class Status:
    """A status: its rows, and the position of its check."""

    name: str
    first_row: int
    row_count: int
    check: int = NO_CHECK

    @property
    def entry(self) -> str:
        """Return its row as C."""
        return f"{{{string(self.name)}, {self.first_row}, {self.row_count}, {self.check}}}"


def node_prefix(node: NodeDecl) -> str:
    """Return what the names of a node's statuses begin with: `arm/motor: `."""
    return f"{node.full_name.removeprefix('/')}: "


def statuses_of(
    application: Application,
    declared: DiagnosisDecl,
    rows: Iterable[CounterRow],
    measured: Iterable[CheckRow],
    diagnostics: Diagnostics,
) -> tuple[tuple[Status, ...], tuple[CounterRow, ...], tuple[CheckRow, ...]]:
    """Return statuses, counters and checks, which name each other by position. Checks of the application are first.

    What the library reports belongs to the first node. A check that is named like a group there is an error.
    """
    prefixes = [node_prefix(node) for node in application.nodes] or [""]
    checks = [_of(check) for check in declared.checks] + [*measured]
    groups: dict[str, list[CounterRow]] = {}
    for row in rows:
        groups.setdefault(row.group, []).append(row)
    for check in checks:
        if check.value:
            groups.setdefault(check.group, [])
    statuses: list[Status] = []
    in_order: list[CounterRow] = []
    for group, own in groups.items():
        index = next((i for i, check in enumerate(checks) if check.value and check.group == group), NO_CHECK)
        if index != NO_CHECK:
            checks[index] = replace(checks[index], status=len(statuses))
        statuses.append(Status(f"{prefixes[0]}{group}", len(in_order), len(own), index))
        in_order += own
    for index, check in enumerate(checks):
        if not check.value:
            checks[index] = replace(check, status=len(statuses))
            statuses.append(Status(f"{prefixes[check.node]}{check.group}", len(in_order), 0, index))
    _check_names(declared, {f"{prefixes[0]}{group}" for group in groups}, prefixes, diagnostics)
    return tuple(statuses), tuple(in_order), tuple(checks)


def _check_names(
    declared: DiagnosisDecl, taken: set[str], prefixes: Sequence[str], diagnostics: Diagnostics
) -> None:
    for check in declared.checks:
        if f"{prefixes[check.node]}{check.name}" in taken:
            message = f"the check '{check.name}' is named like a status of the library"
            diagnostics.error(message, check.span, "Choose another name", id="MG-7099")


def check_counts(
    statuses: Sequence[Status],
    rows: Sequence[CounterRow],
    has_timers: bool,
    span: Span | None,
    diagnostics: Diagnostics,
) -> None:
    """Report more statuses or counters than there are numbers for; `has_timers`: each timer has a counter."""
    for count, what, most in ((len(statuses), "statuses", MOST_STATUSES), (len(rows), "counters", MOST_ROWS)):
        if count > most:
            message = f"a device has {count} {what}, {most} at most"
            hint = f"Remove {count - most} of its checks, callbacks or tasks"
            if what == "counters" and has_timers:
                hint = "Remove `timers: true`"
            diagnostics.error(message, span, hint, id="MG-7095")


def _of(check: CheckDecl) -> CheckRow:
    return CheckRow(
        check.name,
        "value",
        check.limits.warn,
        check.limits.error,
        check.above,
        check.unit,
        check.node,
        check.hysteresis,
        check.timeout_ms,
        check.mode,
    )


def largest(
    statuses: Sequence[Status],
    rows: Sequence[CounterRow],
    checks: Sequence[CheckRow],
    hardware_id: str,
    words: Sequence[str],
) -> int:
    """Return the bytes of the largest message, diagnostic_msgs/msg/DiagnosticArray with one status in CDR."""
    return max(_size(status, rows, checks, hardware_id, words) for status in statuses)


def _size(
    status: Status,
    rows: Sequence[CounterRow],
    checks: Sequence[CheckRow],
    hardware_id: str,
    words: Sequence[str],
) -> int:
    own = rows[status.first_row : status.first_row + status.row_count]
    number = max(_LONGEST_NUMBER, *(len(word) for word in words))
    pairs = [(len(row.key), number if row.words != "NULL" else _LONGEST_NUMBER) for row in own]
    message = max([_STALE, *(len(row.key) + _WORDS for row in own if row.warns)])
    if status.check != NO_CHECK:
        check = checks[status.check]
        message = max(message, len(check.key) + _LIMIT)
        pairs += _pairs_of(check)
    size = _text(_STAMP, 0) + 3 & ~3
    size = _text(size + _COUNT + 1, len(status.name))
    size = _text(_text(size, message), len(hardware_id.encode()))
    size = (size + 3 & ~3) + _COUNT
    for key, value in pairs:
        size = _text(_text(size, key), value)
    return size


def _pairs_of(check: CheckRow) -> list[tuple[int, int]]:
    """Return the sizes of key and value of each pair that a check can have."""
    found = [(len(check.key), _LONGEST_NUMBER)]
    if check.unit:
        found.append((len("unit"), len(check.unit.encode())))
    found += [
        (len(key), _LONGEST_NUMBER)
        for key, limit in (("warn", check.warn), ("error", check.error))
        if limit is not None
    ]
    if check.mode:
        found += [(len("mode"), len(check.mode.encode())), (len("mode waits"), len("false"))]
    return found


def _text(position: int, size: int) -> int:
    """Return where a string of `size` bytes ends that is written at `position`."""
    return (position + 3 & ~3) + 4 + size + 1
