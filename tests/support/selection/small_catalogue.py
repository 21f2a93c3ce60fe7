# SPDX-License-Identifier: Apache-2.0
"""A small catalogue that does not change when the runtime grows, and what a resolution gives."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from microros_gen.selection.component import Catalogue, Component
from microros_gen.selection.model import Selection


def _component(name: str, layer: str = "middleware", **rest: object) -> Component:
    lists: dict[str, Any] = {key: tuple(str(value).split()) for key, value in rest.items() if key != "ready"}
    return Component(name, f"The {name}", layer, bool(rest.get("ready", True)), **lists)


def small_catalogue() -> Catalogue:
    api = "micro-ROS"
    parts = (
        _component("node", api, needs="support session", objects="participant"),
        _component(
            "publish",
            api,
            needs="node cdr session",
            xrce="write",
            sends="WRITE_DATA",
            objects="topic publisher datawriter",
        ),
        _component(
            "subscribe",
            api,
            ready=False,
            needs="node executor cdr_decode session",
            xrce="read",
            sends="READ_DATA",
            receives="DATA",
            objects="topic subscriber datareader",
            pools="subscriptions queue",
        ),
        _component(
            "services",
            api,
            ready=False,
            needs="node executor cdr_decode stream_reliable stream_reliable_input",
            xrce="read write",
            sends="READ_DATA WRITE_DATA",
            receives="DATA",
            objects="requester replier",
            pools="services queue",
        ),
        _component("lifecycle", api, ready=False, needs="executor publish services", xrce="read write"),
        _component("timers", api, ready=False, needs="node clock executor", pools="timers"),
        _component("clock", api, ready=False, needs="node"),
        _component("logging", api, ready=False, needs="node"),
        _component("parameters", api, ready=False, needs="executor publish services", xrce="read write"),
        _component("executor", api, ready=False, needs="node"),
        _component(
            "discovery",
            api,
            ready=False,
            needs="session",
            xrce="discovery",
            sends="GET_INFO",
            receives="INFO",
        ),
        _component("support", needs="session"),
        _component("session", sends="CREATE_CLIENT", receives="STATUS_AGENT"),
        _component("cdr"),
        _component("cdr_decode", ready=False, needs="cdr"),
        _component("stream_best_effort", needs="session"),
        _component("stream_best_effort_input", ready=False, needs="session"),
        _component("stream_reliable", needs="session", sends="HEARTBEAT", receives="ACKNACK"),
        _component(
            "stream_reliable_input",
            ready=False,
            needs="session",
            sends="ACKNACK",
            receives="HEARTBEAT FRAGMENT",
        ),
        _component("sleep_cycles", needs="session node support"),
        _component("session_close", needs="session", sends="DELETE", receives="STATUS"),
        _component("entities", needs="session session_close", sends="CREATE DELETE", receives="STATUS"),
        _component("entities_binary", needs="entities", sends="CREATE", receives="STATUS"),
        _component("entities_xml", ready=False, needs="entities", sends="CREATE", receives="STATUS"),
        _component("entities_reference", ready=False, needs="entities", sends="CREATE", receives="STATUS"),
        _component("entities_preconfigured", ready=False, needs="session"),
        _component("ping", needs="session", sends="GET_INFO", receives="INFO"),
        _component("liveliness_acknack", needs="stream_reliable"),
        _component("framing"),
        _component("transport_udp"),
        _component("transport_tcp", ready=False),
        _component("transport_serial", ready=False),
        _component("transport_canfd", ready=False),
        _component("transport_custom", ready=False),
        _component("logging_rosout", ready=False, needs="logging publish"),
        _component("logging_console", needs="logging"),
        _component("clock_ros", ready=False, needs="clock subscribe"),
        _component("port_posix", "port"),
    )
    return MappingProxyType({part.name: part for part in parts})


@dataclass(frozen=True)
class Outcome:
    """A selection and its messages."""

    selection: Selection
    messages: tuple[str, ...]

    def names(self) -> tuple[str, ...]:
        return tuple(c.component.name for c in self.selection.components)

    def reasons(self, component: str) -> tuple[str, ...]:
        return next(c.reasons for c in self.selection.components if c.component.name == component)
