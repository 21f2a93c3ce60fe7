# SPDX-License-Identifier: Apache-2.0
"""What the agent tells: events as lines for people, or as one JSON object a line."""

from __future__ import annotations

import json
import time
from collections import Counter
from collections.abc import Callable
from enum import IntEnum
from typing import TextIO, Union

Value = str | int | float
Json = Union[Value, bool, "list[Json]", "dict[str, Json]"]
"""A field of an event: what comes from the network is shown as text only after `printable`."""


class Level(IntEnum):
    """How important an event is; -v shows DEBUG, -vv TRACE as well."""

    ERROR = 0
    WARNING = 1
    INFO = 2
    DEBUG = 3
    TRACE = 4


BURST, SUSTAINED = 1_000, 100
"""Lines of one event that are written at once, and how many more each second; those of -v are not counted."""


def printable(text: str) -> str:
    """Return `text` with everything that could steer a terminal replaced; it came from the network."""
    return "".join(c if c.isprintable() else "?" for c in text)


class EventLog:
    """Writes events to one stream. A stream that is gone is ignored: the agent goes on serving."""

    def __init__(
        self, out: TextIO, as_json: bool = False, verbosity: int = 0, clock: Callable[[], float] = time.time
    ) -> None:
        self._out = out
        self._json = as_json
        self._limit = Level.INFO + verbosity
        self._clock = clock
        self._seen: set[str] = set()
        self._credit: dict[str, tuple[float, float]] = {}
        self._withheld: Counter[str] = Counter()
        self.counters: Counter[str] = Counter()

    @property
    def as_json(self) -> bool:
        """Whether events are written for programs."""
        return self._json

    def shows(self, level: Level) -> bool:
        """Return whether events of `level` are written: whoever builds costly ones asks first."""
        return level <= self._limit

    def emit(self, level: Level, event: str, text: str, /, **fields: Json) -> None:
        """Write one event: `text`, for people, is a format string over `fields`; JSON has both.

        Nobody can fill a disk by it, or hold up the agent: see `BURST`. What was not written is told afterwards.
        """
        if level > self._limit or (level <= Level.INFO and not self._may_write(event)):
            return
        if self._withheld[event]:
            count = self._withheld.pop(event)
            told = "{count} events '{of}' before this one were not written: too many at once"
            self.emit(Level.WARNING, "withheld", told, of=event, count=count)
        shown = {key: printable(value) if isinstance(value, str) else value for key, value in fields.items()}
        message = text.format(**shown)
        if self._json:
            moment = round(self._clock(), 6)
            head: dict[str, Json] = {"time": moment, "level": level.name.lower(), "event": event}
            self.line(json.dumps({**head, **fields, "message": message}))
        else:
            self.line(message if level is Level.INFO else f"{level.name.lower()}: {message}")

    def _may_write(self, event: str) -> bool:
        now = self._clock()
        credit, since = self._credit.get(event, (float(BURST), now))
        credit = min(BURST, credit + max(0.0, now - since) * SUSTAINED)
        allowed = credit >= 1
        self._credit[event] = credit - allowed, now
        self._withheld[event] += not allowed
        return allowed

    def count(self, kind: str, text: str, /, **fields: Value) -> None:
        """Count a fault of input; write it the first time that its `kind` occurs."""
        self.counters[kind] += 1
        if kind not in self._seen:
            self._seen.add(kind)
            self.emit(
                Level.WARNING,
                "bad_input",
                text + " ({kind}; further ones are only counted)",
                kind=kind,
                **fields,
            )

    def line(self, text: str) -> None:
        """Write one line at once."""
        try:
            self._out.write(text + "\n")
            self._out.flush()
        except (OSError, ValueError):
            self.counters["log_lost"] += 1
