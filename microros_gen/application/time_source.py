# SPDX-License-Identifier: Apache-2.0
"""`time_source:` of the application file → where the time of day is from, and how it is corrected."""

from __future__ import annotations

from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.tree_values import child, int_of, span_of, text_of, time_of
from microros_gen.documents.yaml_tree import YamlNode
from microros_gen.records import dataclass

KEY = "time_source"
"""Its key in the application file."""
_DAY_US = 86_400_000_000
RANGES = {
    "period": (100_000, _DAY_US, "10 s"),
    "step": (1_000, _DAY_US, "1 s"),
    "holdover": (1_000_000, 7 * _DAY_US, "60 s"),
}
"""Shortest and longest of each, microseconds, and one to write instead of what is outside of these."""
_PERIODS = 6
"""Questions that the agent leaves unanswered before its time is only continued."""
_US_PER_MS = 1000


@dataclass(frozen=True)
class TimeSourceDecl:
    """Everything below `time_source:`. `asks_agent`: the agent is the source; otherwise the application has one.

    `step_us`: an error from which on the time is set instead of corrected; 0: never.
    """

    asks_agent: bool = True
    period_ms: int = 10_000
    slew_ppm: int = 500
    step_us: int = 0
    holdover_ms: int = 60_000
    span: Span | None = None


def parse_time_source(tree: YamlNode | None, diagnostics: Diagnostics) -> TimeSourceDecl | None:
    """Return what is below `time_source:`; None: the file has no such key. Faults are errors at their places."""
    if tree is None:
        return None
    default = TimeSourceDecl()
    asks = text_of(child(tree, "source")) != "application"
    period, step, holdover = (_time(tree, key, diagnostics) for key in RANGES)
    period_ms = default.period_ms if period is None else period // _US_PER_MS
    if not asks and period is not None:
        message = (
            "'period' of a time source is for questions to the agent, and the application has the source"
        )
        diagnostics.error(message, span_of(child(tree, "period")), "Remove it", id="MG-3210")
    if asks and holdover is not None and holdover < _US_PER_MS * period_ms:
        message = (
            f"'holdover' of a time source is {_text(holdover)}, and it asks every {_text(_US_PER_MS * period_ms)}: "
            "the time would be without its source before each answer"
        )
        hint = f"Write holdover: {_text(_PERIODS * _US_PER_MS * period_ms)}, or ask more often"
        diagnostics.error(message, span_of(child(tree, "holdover")), hint, id="MG-9865")
    return TimeSourceDecl(
        asks_agent=asks,
        period_ms=period_ms,
        slew_ppm=int_of(child(tree, "slew_ppm")) or default.slew_ppm,
        step_us=step or 0,
        holdover_ms=max(default.holdover_ms, _PERIODS * period_ms)
        if holdover is None
        else holdover // _US_PER_MS,
        span=tree.span,
    )


def _time(tree: YamlNode, key: str, diagnostics: Diagnostics) -> int | None:
    """Return microseconds; None: the key is not there, or is wrong."""
    least, most, example = RANGES[key]
    node = child(tree, key)
    time = time_of(node)
    if time is not None and not least <= time <= most:
        message = f"'{key}' of a time source is {text_of(node)}; it must be {_text(least)} to {_text(most)}"
        diagnostics.error(message, span_of(node), f"Write {key}: {example}", id="MG-3211")
        return None
    return time


def _text(time_us: int) -> str:
    whole = time_us % 1_000_000 == 0
    return f"{time_us // 1_000_000} s" if whole else f"{time_us // _US_PER_MS} ms"
