# SPDX-License-Identifier: Apache-2.0
"""Collects what managers publish of the parts of a model, and shows it as a table or as data."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from microros_gen.mode_manager.diagnosis import LEVELS, STALE, SUBSYSTEM, TOPIC, TYPE, WARN, Row, read_rows
from microros_gen.modes.model import Model
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from microros_gen.ros.serving import Serving

OLD_S = 5.0
"""A manager that has said nothing of a part for so long does not manage it."""
UNMANAGED = "no manager reports it"
_HEADER = ("part", "target", "actual", "level", "message")
_WAIT_S = 0.2


class Overview:
    """The last row of each part of a model. `clock` gives seconds and never goes back."""

    def __init__(self, model: Model, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._depths = dict(_walk(model, [part.name for part in model.roots], 0))
        self._kinds = {name: "system" if model.parts[name].is_system else "node" for name in self._depths}
        self._known: dict[str, tuple[Row, float]] = {}

    def hear(self, message: Mapping[str, Any]) -> None:
        """Take a message of /diagnostics; what the manager of a system says of it counts more than what others say."""
        for row in read_rows(message):
            known = self._known.get(row.part)
            is_fresh = known is not None and self._clock() - known[1] < OLD_S
            if row.kind == SUBSYSTEM and known is not None and is_fresh and known[0].kind != SUBSYSTEM:
                continue
            self._known[row.part] = row, self._clock()

    def rows(self) -> tuple[Row, ...]:
        """Return a row for each part, those of a system below it."""
        oldest = self._clock() - OLD_S
        return tuple(
            self._known[name][0]
            if name in self._known and self._known[name][1] >= oldest
            else Row(name, self._kinds[name], "", "unknown", STALE, UNMANAGED)
            for name in self._depths
        )

    def table(self) -> str:
        """Return the rows as lines with columns."""
        cells = [
            _HEADER,
            *(
                (
                    "  " * self._depths[row.part] + row.part,
                    row.target,
                    row.actual,
                    LEVELS[row.level],
                    _text(row),
                )
                for row in self.rows()
            ),
        ]
        widths = [max(len(line[i]) for line in cells) for i in range(len(_HEADER))]
        padded = (
            "  ".join(text.ljust(width) for text, width in zip(line, widths, strict=True)) for line in cells
        )
        return "".join(f"{line.rstrip()}\n" for line in padded)

    def data(self) -> dict[str, Any]:
        """Return the rows as data for JSON."""
        return {
            "version": 1,
            "parts": [
                {
                    "part": row.part,
                    "depth": self._depths[row.part],
                    "kind": row.kind,
                    "target": row.target,
                    "actual": row.actual,
                    "level": LEVELS[row.level],
                    "message": row.message,
                    "retries": row.retries,
                    "rule": row.rule,
                    "diagnostics": row.cause,
                }
                for row in self.rows()
            ],
        }

    @property
    def is_at_rest(self) -> bool:
        """Return whether the status of each part is known, and none is on its way."""
        return all(row.level not in (WARN, STALE) for row in self.rows())


class Monitor(Serving):
    """Listens on the node of a peer, in the thread that calls `turn`."""

    def __init__(self, peer: Peer, model: Model, report: Callable[[str], object]) -> None:
        """`report` gets a line about each message that cannot be read."""
        super().__init__(peer, report)
        self.overview = Overview(model, time.monotonic)
        peer.subscribe(TOPIC, TYPE, self.overview.hear, Qos(depth=100))

    def turn(self) -> None:
        """Wait for a message for at most 0.2 s."""
        self._spin(_WAIT_S)


def _walk(model: Model, names: Sequence[str], depth: int) -> Iterable[tuple[str, int]]:
    for name in names:
        yield name, depth
        yield from _walk(model, model.parts[name].part_names, depth + 1)


def _text(row: Row) -> str:
    cause = f" ({row.cause})" if row.cause else ""
    rule = f"rule {row.rule}{cause}" if row.rule else ""
    return "; ".join(text for text in (row.message, rule) if text)
