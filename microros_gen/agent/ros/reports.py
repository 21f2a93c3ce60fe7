# SPDX-License-Identifier: Apache-2.0
"""What a bridge tells about the ROS graph, as events of the log."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict

from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.ros.bridge import (
    GraphReport,
    HashMismatch,
    HashUnknown,
    Incompatible,
    Matched,
    NoServer,
    TypeMismatch,
)

_EVENTS = {
    Matched: (Level.DEBUG, "matched"),
    Incompatible: (Level.WARNING, "incompatible_qos"),
    HashMismatch: (Level.WARNING, "type_hash_mismatch"),
    TypeMismatch: (Level.WARNING, "type_mismatch"),
    NoServer: (Level.WARNING, "no_server"),
    HashUnknown: (Level.WARNING, "type_hash_unknown"),
}


def graph_reporter(log: EventLog) -> Callable[[GraphReport], None]:
    """Return what writes reports to `log`: matches with -v, everything else always."""

    def report(told: GraphReport) -> None:
        level, event = _EVENTS[type(told)]
        log.emit(level, event, "{told}", told=str(told), **asdict(told))

    return report
