# SPDX-License-Identifier: Apache-2.0
"""The checks and callbacks of a diagnosis that a program names: `diagnosis: {checks: […], callbacks: […]}`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from microros_gen.migrate.c_program import Call
from microros_gen.migrate.draft import DraftValue, Flow, Remark, place

_CHECK = ("check", "DIAGNOSIS_", ("rclc_diagnosis_set", "rclc_diagnosis_level"))
_CALLBACK = ("callback", "RCLC_CALLBACK_", ("rclc_diagnosis_watch", "rclc_diagnosis_get_callback"))
"""What it is, the beginning of its constants, and the calls whose first argument is one."""
_NEVER = "above: {error: 2147483647}"
"""Limits that no value exceeds."""


def find_diagnosis(calls: Iterable[Call]) -> tuple[Mapping[str, DraftValue], list[Remark]]:
    """Return `diagnosis` with what the constants of the calls name, and what somebody has to decide of it.

    Nothing in a program says which values are faults, or how long a callback may take.
    """
    every = tuple(calls)
    checks, remarks = _named(every, *_CHECK)
    for name, call in checks.items():
        text = (
            f"the limits of the check '{name}' are not in these sources: with `{_NEVER}` it is never a fault"
        )
        remarks.append(Remark(text, call.span))
    callbacks, more = _named(every, *_CALLBACK)
    for name, call in callbacks.items():
        text = f"how long the callback '{name}' may take is not in these sources: add `limit`"
        more.append(Remark(text, call.span))
    return {
        **_values("checks", dict.fromkeys(checks, f", {_NEVER}"), checks),
        **_values("callbacks", dict.fromkeys(callbacks, ""), callbacks),
    }, remarks + more


def _named(
    calls: Iterable[Call], what: str, constant: str, functions: tuple[str, ...]
) -> tuple[dict[str, Call], list[Remark]]:
    """Return the names of the constants with the first call of each, and the calls that name none."""
    found: dict[str, Call] = {}
    remarks: list[Remark] = []
    for call in calls:
        if call.name not in functions or not call.arguments:
            continue
        names = [t.text for t in call.arguments[0] if t.text.startswith(constant) and t.text != constant]
        if len(names) == 1:
            found.setdefault(names[0].removeprefix(constant).lower(), call)
        else:
            shown = "".join(token.text for token in call.arguments[0])
            text = f"{call.name}: the {what} `{shown}` is worked out when the program runs"
            remarks.append(Remark(text, call.span))
    return found, remarks


def _values(key: str, named: Mapping[str, str], found: Mapping[str, Call]) -> dict[str, DraftValue]:
    """Return the value of a key: a list of mappings with the names, each followed by its text."""
    if not found:
        return {}
    first = next(iter(found.values()))
    items = ", ".join(f"{{name: {name}{rest}}}" for name, rest in named.items())
    return {key: DraftValue(Flow(f"[{items}]"), f"{first.name} ({place(first.span)})")}
