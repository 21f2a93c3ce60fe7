# SPDX-License-Identifier: Apache-2.0
"""The callbacks whose times a device reports: their counters, and the entities of the example that they belong to."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from microros_gen.application.diagnosis_decl import CallbackDecl
from microros_gen.client.views.example_running import RunningView
from microros_gen.components.diagnosis.tables import CounterRow

CALLBACK = "callback "
"""What the group of a callback begins with: no name of a check has a space."""
_HEADER = "microros/rclc_diagnosis_times.h"


def constant_of(callback: CallbackDecl) -> str:
    """Return the name of its position as C."""
    return f"RCLC_CALLBACK_{callback.name.upper()}"


def callback_rows(callbacks: Sequence[CallbackDecl]) -> Iterator[CounterRow]:
    """Yield the counters of each callback, each in a separate status; overruns only where it has a limit."""
    for index, callback in enumerate(callbacks):
        group = f"{CALLBACK}{callback.name}"
        for key in ("runs", "last_us", "longest_us", *(("overruns",) if callback.limit_us else ())):
            value = f"rclc_diagnosis_times({index})->{key}"
            yield CounterRow(group, key, value, warns=key == "overruns", header=_HEADER)


def example_watch(callbacks: Sequence[CallbackDecl], running: RunningView | None) -> Iterator[str]:
    """Yield statements of the example, which watch the entities that are named like a declared callback."""
    entities = dict(_entities(running)) if running is not None else {}
    for callback in callbacks:
        if callback.name in entities:
            call = f"rclc_diagnosis_watch((uint8_t){constant_of(callback)}, &{entities[callback.name]})"
            yield from ("  if (result == RCL_RET_OK) {", f"    result = {call};", "  }")


def _entities(running: RunningView) -> Iterator[tuple[str, str]]:
    """Yield names and variables of what the example calls back. Of one name, the last counts: that of a timer.

    The name of a topic or service is the part after its last slash.
    """
    for service in (*running.clients, *running.services):
        yield service.name.rpartition("/")[2], service.variable
    for received in running.received:
        yield received.topic.rpartition("/")[2], received.variable
    for timer in running.timers:
        yield timer.name, timer.variable
