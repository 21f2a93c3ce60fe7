# SPDX-License-Identifier: Apache-2.0
"""The times below `session:` of the application file."""

from __future__ import annotations

from microros_gen.application.model import SessionTimes
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.tree_values import child, span_of, text_of, time_of
from microros_gen.documents.yaml_tree import YamlNode

SHORTEST_SILENCE_MS, LONGEST_SILENCE_MS = 100, 999_000
"""What `session.hard_liveliness` can be, milliseconds; agents are told six digits."""

MINUTE_MS, HOUR_MS, DAY_MS = 60_000, 3_600_000, 86_400_000

RANGES = {
    "round_trip": (10, MINUTE_MS, "300 ms"),
    "retry_max": (10, HOUR_MS, "60 s"),
    "heartbeat": (10, MINUTE_MS, "100 ms"),
    "liveliness_period": (10, DAY_MS, "60 s"),
    "liveliness_timeout": (30, HOUR_MS, "3 s"),
    "connect_timeout": (1, HOUR_MS, "1 s"),
    "create_timeout": (1, HOUR_MS, "1 s"),
    "close_timeout": (0, HOUR_MS, "300 ms"),
}
"""Shortest and longest of each, and one to write instead of what is outside of these."""


def hard_liveliness(node: YamlNode | None, diagnostics: Diagnostics) -> int:
    """Return the milliseconds of `session.hard_liveliness`; 0: it is not there."""
    return _time(node, "hard_liveliness", SHORTEST_SILENCE_MS, LONGEST_SILENCE_MS, "10 s", diagnostics) or 0


def session_times(node: YamlNode | None, diagnostics: Diagnostics) -> SessionTimes:
    """Return what `session:` says of times."""
    found = {key: _time(node, key, *limits, diagnostics) for key, limits in RANGES.items()}
    first, most = found["round_trip"], found["retry_max"]
    if first is not None and most is not None and most < first:
        message = f"'session.retry_max' is {text_of(child(node, 'retry_max'))}, less than `round_trip`"
        diagnostics.error(
            message,
            span_of(child(node, "retry_max")),
            f"Write `retry_max: {_text(first)}` or more",
            id="MG-3031",
        )
    return SessionTimes(**found)


def _time(
    node: YamlNode | None, key: str, least: int, most: int, instead: str, diagnostics: Diagnostics
) -> int | None:
    time = child(node, key)
    microseconds = time_of(time)
    if microseconds is None:
        return None
    milliseconds = microseconds // 1000
    if not least <= milliseconds <= most:
        message = f"'session.{key}' must be between {_text(least)} and {_text(most)}; it is {text_of(time)}"
        diagnostics.error(message, span_of(time), f"Write `{key}: {instead}`", id="MG-3032")
    return milliseconds


def _text(milliseconds: int) -> str:
    whole = milliseconds % 1000 == 0 and milliseconds
    return f"{milliseconds // 1000} s" if whole else f"{milliseconds} ms"
