# SPDX-License-Identifier: Apache-2.0
"""The agent's log: events as readable lines, or as one JSON object per line."""

from __future__ import annotations

import json
import os
import time
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import TextIO, Union

Value = str | int | float
Json = Union[Value, bool, "list[Json]", "dict[str, Json]"]
"""A field of an event. Text from the network is shown only after `printable`."""


class Level(IntEnum):
    """Importance of an event; -v also shows DEBUG, -vv also TRACE."""

    ERROR = 0
    WARNING = 1
    INFO = 2
    DEBUG = 3
    TRACE = 4


BURST, SUSTAINED = 1_000, 100
"""Lines of one event in a burst, and per second on average; those of -v are not counted."""
LONGEST = 400
"""Maximum characters of a text in a line; the middle of a longer one is omitted, except with -v."""
BYTES_AT_ONCE, BYTES_PER_SECOND = 1 << 20, 16_384
"""Bytes of lines in a burst, and per second on average; those of -v are not counted."""
REPEATED_S, REPEATED = 10.0, 3
"""Maximum number of identical consecutive warnings of an event, and the seconds in which; further ones are counted."""
ALWAYS = ("stopped", "memory_tight", "memory_relieved")
"""Events that are always written."""


def printable(text: str) -> str:
    """Return `text` from the network without control characters, which a terminal would execute."""
    return "".join(c if c.isprintable() else "?" for c in text)


def _short(text: str) -> str:
    """Return `text`; if it is long, its beginning, its length and its end."""
    if len(text) <= LONGEST:
        return text
    return f"{text[: LONGEST // 2]}… ({len(text)} characters) …{text[-LONGEST // 2 :]}"


@dataclass
class _Repeated:
    """A warning, when it was written, and the number of its repetitions since then."""

    message: str
    since: float
    count: int = 0


class EventLog:
    """Writer of events to one stream. A closed stream is ignored: the agent continues."""

    def __init__(
        self,
        out: TextIO,
        as_json: bool = False,
        verbosity: int = 0,
        clock: Callable[[], float] = time.time,
        bytes_per_second: int = BYTES_PER_SECOND,
        worker: int | None = None,
    ) -> None:
        """`worker`: number of the process in each line, if the agent has several."""
        self._worker: dict[str, Json] = {} if worker is None else {"worker": worker}
        self._out = out
        self._descriptor = _descriptor_of(out)
        self._json = as_json
        self._limit = Level.INFO + verbosity
        self._clock = clock
        self._seen: set[str] = set()
        self._credit: dict[str, tuple[float, float]] = {}
        self._withheld: Counter[str] = Counter()
        self._bytes_per_second = bytes_per_second
        self._bytes, self._bytes_at = float(BYTES_AT_ONCE), clock()
        self._before: dict[str, _Repeated] = {}
        """The last warning of each event."""
        self.counters: Counter[str] = Counter()
        self.on_warning: Callable[[str, str], None] | None = None
        """Called with the key of a client and a text for each warning about it, whether it is written or not."""

    @property
    def as_json(self) -> bool:
        """Whether events are written as JSON."""
        return self._json

    def shows(self, level: Level) -> bool:
        """Return whether events of `level` are written; for callers that build expensive ones."""
        return level <= self._limit

    def emit(self, level: Level, event: str, text: str, /, **fields: Json) -> None:
        """Write one event. `text` is a format string for people, over `fields`; JSON contains both.

        The number of lines is limited (see `BURST`), so no sender can fill a disk or delay the agent. Suppressed lines
        are counted and reported.
        """
        if level is Level.WARNING and self.on_warning is not None:
            self._pass_on(text, fields)
        if level > self._limit:
            return
        if level > Level.INFO:
            self._write(level, event, text, fields)
            return
        if not self._may_write(event):
            self._withheld[event] += 1
            return
        short = {key: _short(value) if isinstance(value, str) else value for key, value in fields.items()}
        if level is Level.WARNING and self._is_repeated(event, text.format(**short)):
            return
        self._pay(event)
        if self._withheld[event]:
            count = self._withheld.pop(event)
            reported = "{count} events '{of}' before this one were not written: too many at once"
            self._write(Level.WARNING, "withheld", reported, {"of": event, "count": count})
        self._write(level, event, text, short)

    def finish(self) -> None:
        """Report how often suppressed warnings were repeated."""
        for event in list(self._before):
            self._report_repeated(event)

    def _write(self, level: Level, event: str, text: str, fields: Mapping[str, Json]) -> None:
        shown = {key: printable(value) if isinstance(value, str) else value for key, value in fields.items()}
        message = text.format(**shown)
        if self._json:
            time_s = round(self._clock(), 6)
            head: dict[str, Json] = {"time": time_s, "level": level.name.lower(), "event": event}
            line = json.dumps({**head, **self._worker, **fields, "message": message})
        else:
            line = message if level is Level.INFO else f"{level.name.lower()}: {message}"
            line = f"worker {self._worker['worker']}: {line}" if self._worker else line
        if level <= Level.INFO:
            self._bytes -= len(line)
        self.line(line)

    def _is_repeated(self, event: str, message: str) -> bool:
        """Return whether a warning equals the previous one of its event, and count it then."""
        before, now = self._before.get(event), self._clock()
        if before is not None and before.message == message and now - before.since < REPEATED_S:
            before.count += 1
            return before.count >= REPEATED
        if before is not None:
            self._report_repeated(event)
        self._before[event] = _Repeated(message, now)
        return False

    def _report_repeated(self, event: str) -> None:
        before = self._before.pop(event)
        if before.count >= REPEATED:
            count = before.count - REPEATED + 1
            fields: dict[str, Json] = {"of": event, "count": count, "what": before.message}
            self._write(Level.WARNING, "repeated", "{what} … repeated {count} times", fields)

    def _may_write(self, event: str) -> bool:
        """Return whether the limits of lines per event and of bytes permit one more line."""
        now = self._clock()
        passed = max(0.0, now - self._bytes_at)
        self._bytes = min(BYTES_AT_ONCE, self._bytes + passed * self._bytes_per_second)
        self._bytes_at = now
        credit, since = self._credit.get(event, (float(BURST), now))
        self._credit[event] = min(BURST, credit + max(0.0, now - since) * SUSTAINED), now
        return event in ALWAYS or (self._credit[event][0] >= 1 and self._bytes > 0)

    def _pay(self, event: str) -> None:
        credit, since = self._credit[event]
        self._credit[event] = credit - 1, since

    def count(self, kind: str, text: str, /, **fields: Value) -> None:
        """Count a fault in input; write the first one of its `kind`."""
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
        elif self.on_warning is not None:
            self._pass_on(text, {"kind": kind, **fields})

    def _pass_on(self, text: str, fields: Mapping[str, Json]) -> None:
        client = fields.get("client")
        if self.on_warning is not None and isinstance(client, str):
            short = {key: _short(value) if isinstance(value, str) else value for key, value in fields.items()}
            self.on_warning(client, printable(text.format(**short)))

    def line(self, text: str) -> None:
        """Write one line at once.

        In one call of the system, if `out` has a descriptor: lines of several processes do not mix in a file then, nor
        in a pipe up to PIPE_BUF (4,096 bytes). The buffers of Python would divide lines of more than 8 KiB.
        """
        try:
            if self._descriptor < 0:
                self._out.write(text + "\n")
                self._out.flush()
                return
            rest = f"{text}\n".encode(self._out.encoding, "backslashreplace")
            while rest:  # a signal or a full disk may end a call early
                rest = rest[os.write(self._descriptor, rest) :]
        except (OSError, ValueError):
            self.counters["log_lost"] += 1


def _descriptor_of(out: TextIO) -> int:
    """Return the descriptor of a stream with nothing left to write; -1 if it has none."""
    try:
        out.flush()
        return out.fileno()
    except (OSError, ValueError, AttributeError):
        return -1
