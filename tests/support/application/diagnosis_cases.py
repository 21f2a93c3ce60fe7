# SPDX-License-Identifier: Apache-2.0
"""For each key below `diagnosis:` a value that is taken, what it becomes, and one that is refused."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from microros_gen.application.diagnosis_decl import CheckDecl, DiagnosisDecl
from microros_gen.application.model import Application
from tests.support.application.key_case import KeyCase


def _diagnosis(read: Callable[[DiagnosisDecl], Any]) -> Callable[[Application], Any]:
    def of_application(application: Application) -> Any:
        assert application.diagnosis is not None
        return read(application.diagnosis)

    return of_application


def _check(read: Callable[[CheckDecl], Any]) -> Callable[[Application], Any]:
    return _diagnosis(lambda diagnosis: read(diagnosis.checks[0]))


def _in_check(text: str) -> str:
    return f"nodes: [{{name: n}}]\ndiagnosis:\n  checks:\n    - {{name: a, {text}}}\n"


def _level_of(key: str, level: str, diagnosis: DiagnosisDecl) -> Any:
    return getattr(getattr(diagnosis, key), level)


def _level(level: str, check: CheckDecl) -> Any:
    return getattr(check.limits, level)


def _limits(key: str) -> dict[str, KeyCase]:
    """Return the cases of limits in percent or millivolts."""
    path = f"diagnosis.{key}"
    high = 1_000_000 if key == "supply" else 100
    return {
        path: KeyCase(
            f"diagnosis: {{{key}: {{warn: 5}}}}",
            _diagnosis(lambda d: getattr(d, key).warn),
            5,
            f"diagnosis: {{{key}: 5}}",
            f"1:{15 + len(key)}",
            f"'{path}' must be a mapping with `warn`, `error` or both; it is 5",
        ),
        **{
            f"{path}.{level}": KeyCase(
                f"diagnosis: {{{key}: {{{level}: {high}}}}}",
                _diagnosis(partial(_level_of, key, level)),
                high,
                f"diagnosis: {{{key}: {{{level}: 0}}}}",
                f"1:{18 + len(key) + len(level)}",
                f"'{path}.{level}' must be a whole number between 1 and {high}; it is 0",
            )
            for level in ("warn", "error")
        },
    }


def _check_limits(key: str) -> dict[str, KeyCase]:
    """Return the cases of limits of a check, on one side of it."""
    path = f"diagnosis.checks[].{key}"
    return {
        path: KeyCase(
            _in_check(f"{key}: {{error: -7}}"),
            _check(lambda c: (c.above, c.limits.warn, c.limits.error)),
            (key == "above", None, -7),
            _in_check(f"{key}: 1"),
            "4:24",
            f"'diagnosis.checks[0].{key}' must be a mapping with `warn`, `error` or both; it is 1",
        ),
        **{
            f"{path}.{level}": KeyCase(
                _in_check(f"{key}: {{{level}: 3}}"),
                _check(partial(_level, level)),
                3,
                _in_check(f"{key}: {{{level}: x}}"),
                f"4:{27 + len(level)}",
                f"'diagnosis.checks[0].{key}.{level}' must be a whole number between -2147483648 and",
            )
            for level in ("warn", "error")
        },
    }


DIAGNOSIS_CASES: dict[str, KeyCase] = {
    "diagnosis": KeyCase(
        "diagnosis: {}",
        _diagnosis(lambda d: (d.period_ms, d.stack.warn, d.cpu.warn)),
        (1000, 90, 95),
        "diagnosis: 3",
        "1:12",
        "'diagnosis' must be a mapping such as {period: 1 s, hardware_id: board-7}; it is 3",
    ),
    "diagnosis.period": KeyCase(
        "diagnosis: {period: 250 ms}",
        _diagnosis(lambda d: d.period_ms),
        250,
        "diagnosis: {period: 5}",
        "1:21",
        "'diagnosis.period' must be a time with its unit such as 20 ms",
    ),
    "diagnosis.hardware_id": KeyCase(
        "diagnosis: {hardware_id: board-7}",
        _diagnosis(lambda d: d.hardware_id),
        "board-7",
        f"diagnosis: {{hardware_id: {'a' * 65}}}",
        "1:26",
        "'diagnosis.hardware_id' must be a text of at most 64 characters",
    ),
    "diagnosis.deadline": KeyCase(
        "diagnosis: {deadline: 5 ms}",
        _diagnosis(lambda d: d.deadline_us),
        5000,
        "diagnosis: {deadline: 3}",
        "1:23",
        "'diagnosis.deadline' must be a time with its unit such as 20 ms",
    ),
    "diagnosis.timers": KeyCase(
        "diagnosis: {timers: true}",
        _diagnosis(lambda d: d.timers),
        True,
        "diagnosis: {timers: 3}",
        "1:21",
        "'diagnosis.timers' must be true or false",
    ),
    **_limits("stack"),
    **_limits("cpu"),
    **_limits("supply"),
    "diagnosis.checks": KeyCase(
        _in_check("above: {warn: 1}"),
        _diagnosis(lambda d: len(d.checks)),
        1,
        "diagnosis: {checks: []}",
        "1:21",
        "'diagnosis.checks' must be a list with at least one item",
    ),
    "diagnosis.checks[].name": KeyCase(
        _in_check("above: {warn: 1}"),
        _check(lambda c: c.name),
        "a",
        "diagnosis: {checks: [{name: 3, above: {warn: 1}}]}",
        "1:29",
        "'diagnosis.checks[0].name' must be a name of lower-case letters",
    ),
    "diagnosis.checks[].unit": KeyCase(
        _in_check("unit: mV, above: {warn: 1}"),
        _check(lambda c: c.unit),
        "mV",
        _in_check("unit: seventeen letters, above: {warn: 1}"),
        "4:23",
        "'diagnosis.checks[0].unit' must be a text of at most 16 characters",
    ),
    "diagnosis.checks[].node": KeyCase(
        _in_check("node: n, above: {warn: 1}"),
        _check(lambda c: c.node),
        0,
        _in_check("node: 3, above: {warn: 1}"),
        "4:23",
        "'diagnosis.checks[0].node' must be a text; it is 3",
    ),
    **_check_limits("above"),
    **_check_limits("below"),
    "diagnosis.checks[].hysteresis": KeyCase(
        _in_check("hysteresis: 4, above: {warn: 1}"),
        _check(lambda c: c.hysteresis),
        4,
        _in_check("hysteresis: -1, above: {warn: 1}"),
        "4:29",
        "'diagnosis.checks[0].hysteresis' must be a whole number between 0 and 2147483647; it is -1",
    ),
    "diagnosis.checks[].timeout": KeyCase(
        _in_check("timeout: 2 s, above: {warn: 1}"),
        _check(lambda c: c.timeout_ms),
        2000,
        _in_check("timeout: 1, above: {warn: 1}"),
        "4:26",
        "'diagnosis.checks[0].timeout' must be a time with its unit such as 20 ms",
    ),
    "diagnosis.checks[].mode": KeyCase(
        "nodes: [{name: n, parameters: [{name: v, type: double}], modes: {SLOW: {v: 1.0}}}]\n"
        "diagnosis: {checks: [{name: a, mode: SLOW, above: {error: 1}}]}\n",
        _check(lambda c: c.mode),
        "SLOW",
        _in_check("mode: 1, above: {error: 1}"),
        "4:23",
        "'diagnosis.checks[0].mode' must be a text; it is 1",
    ),
    "diagnosis.callbacks": KeyCase(
        "diagnosis: {callbacks: [{name: tick}, {name: other}]}",
        _diagnosis(lambda d: len(d.callbacks)),
        2,
        "diagnosis: {callbacks: [tick]}",
        "1:25",
        "'diagnosis.callbacks[0]' must be a mapping such as {name: tick, limit: 2 ms}",
    ),
    "diagnosis.callbacks[].name": KeyCase(
        "diagnosis: {callbacks: [{name: tick}]}",
        _diagnosis(lambda d: d.callbacks[0].name),
        "tick",
        "diagnosis: {callbacks: [{name: 3}]}",
        "1:32",
        "'diagnosis.callbacks[0].name' must be a name of lower-case letters",
    ),
    "diagnosis.callbacks[].limit": KeyCase(
        "diagnosis: {callbacks: [{name: tick, limit: 2 ms}]}",
        _diagnosis(lambda d: d.callbacks[0].limit_us),
        2000,
        "diagnosis: {callbacks: [{name: tick, limit: 2}]}",
        "1:45",
        "'diagnosis.callbacks[0].limit' must be a time with its unit such as 20 ms",
    ),
}
