# SPDX-License-Identifier: Apache-2.0
"""What a manager knows of its parts as diagnostic_msgs/msg/DiagnosticArray, and what it reads of such messages."""

from __future__ import annotations

import time
from collections.abc import Collection, Iterator, Mapping
from typing import Any

from microros_gen.mode_manager.orchestrator import Orchestrator
from microros_gen.modes.model import (
    ERROR,
    ERROR_LEVEL,
    MANAGER_HARDWARE,
    STALE_LEVEL,
    UNKNOWN,
    WARN_LEVEL,
    DiagnosticLevels,
    Status,
    part_of,
)
from microros_gen.records import dataclass

TOPIC = "/diagnostics"
TYPE = "diagnostic_msgs/msg/DiagnosticArray"
PREFIX = "modes: "
OK, WARN, FAILED, STALE = range(4)
"""Levels of diagnostic_msgs/msg/DiagnosticStatus."""
NODE, SYSTEM, SUBSYSTEM = "node", "system", "subsystem"
"""What a row is about; a subsystem has another manager."""
LEVELS = ("ok", "warning", "error", "stale")
_NAMES = {WARN: WARN_LEVEL, FAILED: ERROR_LEVEL, STALE: STALE_LEVEL}
_NS = 1_000_000_000


@dataclass(frozen=True)
class Row:
    """One part. Texts of statuses are `state` or `state.MODE`; `target` is empty if nothing was requested."""

    part: str
    kind: str
    target: str
    actual: str
    level: int
    message: str
    retries: int = 0
    rule: str = ""
    cause: str = ""
    """The status on /diagnostics for which `rule` was applied."""


def rows_of(manager: Orchestrator) -> tuple[Row, ...]:
    """Return a row for each part of the scope."""
    statuses = manager.statuses()
    return tuple(_row(manager, name, statuses[name]) for name in manager.scope.names)


def _row(manager: Orchestrator, name: str, actual: Status) -> Row:
    target = manager.targets.get(name)
    leaf = manager.leaves.get(name)
    level, message = OK, ""
    if leaf is not None and (leaf.problem or (leaf.failure and target is not None)):
        reason = leaf.failure if not leaf.problem or leaf.reaction else ""
        level, message = FAILED, ": ".join(text for text in (reason, leaf.problem) if text)
    elif leaf is not None and actual.state == UNKNOWN:
        level, message = STALE, leaf.failure or "it is not known yet"
    elif actual.state == ERROR or name in manager.oscillating:
        level = FAILED
        message = "its rules oscillate" if name in manager.oscillating else "a part of it has an error"
    elif target is not None and manager.progress.is_moving(name):
        blocker = manager.progress.blocker(name) if leaf is not None else ""
        level, message = WARN, f"it waits for {blocker}" if blocker else "it is on its way"
    elif target is not None and not _is_reached(manager, name, actual, target):
        blocker = manager.progress.blocker(name) if leaf is not None else ""
        level, message = FAILED, f"it waits for {blocker}" if blocker else "it is not in its target"
    kind = SYSTEM if leaf is None else SUBSYSTEM if leaf.part.is_system else NODE
    return Row(
        name,
        kind,
        str(target) if target is not None else "",
        str(actual),
        level,
        message,
        leaf.retries if leaf is not None else 0,
        manager.rules.get(name, ""),
        manager.cause(name),
    )


def _is_reached(manager: Orchestrator, name: str, actual: Status, target: Status) -> bool:
    leaf = manager.leaves.get(name)
    return leaf.is_settled(actual) if leaf is not None else actual.is_same(target)


def array_of(rows: Collection[Row]) -> dict[str, Any]:
    """Return the rows as a message."""
    seconds, nanoseconds = divmod(time.time_ns(), _NS)
    return {
        "header": {"stamp": {"sec": seconds, "nanosec": nanoseconds}},
        "status": [
            {
                "level": row.level,
                "name": f"{PREFIX}{row.part}",
                "message": row.message or LEVELS[OK],
                "hardware_id": MANAGER_HARDWARE,
                "values": [
                    {"key": key, "value": str(value)}
                    for key, value in (
                        ("kind", row.kind),
                        ("target", row.target),
                        ("actual", row.actual),
                        ("retries", row.retries),
                        ("rule", row.rule),
                        ("diagnostics", row.cause),
                    )
                ],
            }
            for row in rows
        ],
    }


def read_rows(message: Mapping[str, Any]) -> Iterator[Row]:
    """Yield the rows of a message of a manager; what others publish is passed over."""
    for status in message["status"]:
        if status["hardware_id"] != MANAGER_HARDWARE or not status["name"].startswith(PREFIX):
            continue
        values = {pair["key"]: pair["value"] for pair in status["values"]}
        retries = values.get("retries", "")
        yield Row(
            status["name"][len(PREFIX) :],
            values.get("kind", ""),
            values.get("target", ""),
            values.get("actual", ""),
            int(status["level"]),
            "" if status["level"] == OK else status["message"],
            int(retries) if retries.isdecimal() else 0,
            values.get("rule", ""),
            values.get("diagnostics", ""),
        )


@dataclass(frozen=True)
class PartStatus:
    """A status of a part. `name` is without that of the part; `level` is empty: it is OK; `error`: it is none."""

    part: str
    name: str
    level: str
    error: str


@dataclass(frozen=True)
class OtherStatus:
    """A status of no part, with its whole name; `level` is empty: it is OK."""

    hardware: str
    name: str
    level: str


def read_others(message: Mapping[str, Any], parts: Collection[str]) -> Iterator[OtherStatus]:
    """Yield each status of a message that belongs to none of the parts of a model, and not to a mode manager."""
    for status in message["status"]:
        if not part_of(status["name"], parts) and status["hardware_id"] != MANAGER_HARDWARE:
            level = _NAMES.get(int(status["level"]), "")
            yield OtherStatus(status["hardware_id"], status["name"], level)


def read_statuses(message: Mapping[str, Any], levels: Mapping[str, DiagnosticLevels]) -> Iterator[PartStatus]:
    """Yield each status of a message that belongs to one of the parts.

    `levels` says for each part which levels are errors.
    """
    for status in message["status"]:
        part = part_of(status["name"], levels)
        if not part or status["hardware_id"] == MANAGER_HARDWARE:
            continue
        own = status["name"].lstrip("/")[len(part) :].lstrip(":").strip()
        word = _NAMES.get(int(status["level"]), "")
        yield PartStatus(part, own, word, error_of(levels[part], own, word, status["message"]))


def error_of(levels: DiagnosticLevels, name: str, level: str, message: str) -> str:
    """Return the text of an error of a part; empty: the level, which is empty for OK, is none for the status `name`."""
    return (message or level) if level and levels.is_error(level, name) else ""
