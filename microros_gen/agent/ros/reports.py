# SPDX-License-Identifier: Apache-2.0
"""Reports of a bridge about the ROS graph, as events of the log."""

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
    NoClient,
    NoServer,
    OtherDomain,
    ServerFound,
    TypeMismatch,
)

_EVENTS = {
    Matched: (Level.DEBUG, "matched"),
    Incompatible: (Level.WARNING, "incompatible_qos"),
    HashMismatch: (Level.WARNING, "type_hash_mismatch"),
    TypeMismatch: (Level.WARNING, "type_mismatch"),
    NoServer: (Level.WARNING, "no_server"),
    ServerFound: (Level.INFO, "server_found"),
    NoClient: (Level.INFO, "no_client"),
    HashUnknown: (Level.WARNING, "type_hash_unknown"),
    OtherDomain: (Level.WARNING, "other_domain"),
}


def graph_reporter(log: EventLog) -> Callable[[GraphReport], None]:
    """Return a function that writes reports to `log`: matches with -v, all others always.

    Of dropped requests and replies, the first one of each endpoint is reported; all are counted.
    """

    def report(graph_report: GraphReport) -> None:
        level, event = _EVENTS[type(graph_report)]
        if isinstance(graph_report, NoServer | NoClient):
            log.counters[event] += 1
            if graph_report.lost > 1:
                return
        log.emit(level, event, "{told}", told=str(graph_report), **asdict(graph_report))

    return report
