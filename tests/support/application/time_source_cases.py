# SPDX-License-Identifier: Apache-2.0
"""For each key below `time_source:` a value that is taken, what it becomes, and one that is refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from microros_gen.application.model import Application
from microros_gen.application.time_source import TimeSourceDecl
from tests.support.application.key_case import KeyCase


def _source(read: Callable[[TimeSourceDecl], Any]) -> Callable[[Application], Any]:
    def of_application(application: Application) -> Any:
        assert application.time_source is not None
        return read(application.time_source)

    return of_application


def _time(key: str, text: str, read: Callable[[TimeSourceDecl], Any], value: int) -> KeyCase:
    return KeyCase(
        f"time_source: {{{key}: {text}}}",
        _source(read),
        value,
        f"time_source: {{{key}: 5}}",
        f"1:{17 + len(key)}",
        f"'time_source.{key}' must be a time with its unit such as 20 ms (units us, ms, s); it is 5",
    )


TIME_SOURCE_CASES = {
    "time_source": KeyCase(
        "time_source: {}",
        _source(lambda s: (s.asks_agent, s.period_ms)),
        (True, 10_000),
        "time_source: agent",
        "1:14",
        "'time_source' must be a mapping such as {source: agent, period: 10 s}; it is the text 'agent'",
    ),
    "time_source.source": KeyCase(
        "time_source: {source: application}",
        _source(lambda s: s.asks_agent),
        False,
        "time_source: {source: gps}",
        "1:23",
        "'time_source.source' must be agent or application; it is the text 'gps'",
    ),
    "time_source.period": _time("period", "2.5 s", lambda s: s.period_ms, 2500),
    "time_source.step": _time("step", "1 ms", lambda s: s.step_us, 1000),
    "time_source.holdover": _time("holdover", "3600 s", lambda s: s.holdover_ms, 3_600_000),
    "time_source.slew_ppm": KeyCase(
        "time_source: {slew_ppm: 100000}",
        _source(lambda s: s.slew_ppm),
        100_000,
        "time_source: {slew_ppm: 0}",
        "1:25",
        "'time_source.slew_ppm' must be a whole number between 1 and 100000; it is 0",
    ),
}
