# SPDX-License-Identifier: Apache-2.0
"""The checks of a diagnosis that a program sets or looks at: `diagnosis: {checks: […]}`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from microros_gen.migrate.c_program import Call
from microros_gen.migrate.draft import DraftValue, Flow, Remark, place

_CALLS = ("rclc_diagnosis_set", "rclc_diagnosis_level")
_CONSTANT = "DIAGNOSIS_"
_NEVER = "above: {error: 2147483647}"
"""Limits that no value exceeds."""


def find_checks(calls: Iterable[Call]) -> tuple[Mapping[str, DraftValue], list[Remark]]:
    """Return `diagnosis` with a check for each constant of the calls, and what somebody has to decide of it.

    Nothing in a program says which values are faults.
    """
    found: dict[str, Call] = {}
    remarks: list[Remark] = []
    for call in calls:
        if call.name not in _CALLS or not call.arguments:
            continue
        names = [t.text for t in call.arguments[0] if t.text.startswith(_CONSTANT) and t.text != _CONSTANT]
        if len(names) == 1:
            found.setdefault(names[0].removeprefix(_CONSTANT).lower(), call)
        else:
            shown = "".join(token.text for token in call.arguments[0])
            remarks.append(
                Remark(f"{call.name}: the check `{shown}` is worked out when the program runs", call.span)
            )
    if not found:
        return {}, remarks
    for name, call in found.items():
        text = (
            f"the limits of the check '{name}' are not in these sources: with `{_NEVER}` it is never a fault"
        )
        remarks.append(Remark(text, call.span))
    first = next(iter(found.values()))
    checks = ", ".join(f"{{name: {name}, {_NEVER}}}" for name in found)
    return {"checks": DraftValue(Flow(f"[{checks}]"), f"{first.name} ({place(first.span)})")}, remarks
