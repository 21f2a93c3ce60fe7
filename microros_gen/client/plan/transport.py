# SPDX-License-Identifier: Apache-2.0
"""The transport: where the agent is, and how bytes reach it."""

from __future__ import annotations

from microros_gen.application.model import DISCOVERY_PORT, Application
from microros_gen.application.transport_decl import Transport
from microros_gen.client.plan.board import RING_CHUNK
from microros_gen.client.plan.slices import DISCOVERY_GROUP, LINE_CHUNK, TransportPlan
from microros_gen.client.plan.streams import StreamSizes
from microros_gen.platform.target import Target
from microros_gen.selection.model import Selection

_FRAMING = {True: "on", False: "off", None: "either"}


def plan_transport(
    application: Application, selection: Selection, target: Target, streams: StreamSizes, own_driver: bool
) -> TransportPlan:
    """Plan the transport. `own_driver`: the serial line belongs to a driver of the platform."""
    requested = application.transport
    host, port = _agent(requested, selection)
    return TransportPlan(
        kind=selection.transport,
        agent_host=host,
        agent_port=port,
        has_discovery=selection.has("discovery"),
        discovery_port=requested.discover or DISCOVERY_PORT,
        framing=_FRAMING[requested.framing],
        device=_device(requested, target) if selection.transport == "serial" else "",
        baud=requested.baud,
        send_buffer=streams.send_buffer,
        keeps_output=streams.keeps_output,
        line_input=streams.line_input,
        line_chunk=RING_CHUNK if own_driver else LINE_CHUNK,
        read_polls=requested.read_polls,
        wakes_for_room=_wakes_for_room(application, selection, target),
        wakes=target.wakes(selection.transport),
    )


def _wakes_for_room(application: Application, selection: Selection, target: Target) -> bool:
    """Return whether room in the line ends the wait of the session's task."""
    return bool(application.tasks) and target.waits_for_room(selection.transport)


def _device(transport: Transport, target: Target) -> str:
    """Return the name of the serial line; empty: the only line of a board."""
    if not target.names_lines:
        return ""
    has_default = transport.device == Transport.device
    return target.os.device or transport.device if has_default else transport.device


def _agent(transport: Transport, selection: Selection) -> tuple[str, int]:
    """Return host and port of the agent; the group where agents are asked for when none is named."""
    if transport.discover is not None:
        return DISCOVERY_GROUP, transport.discover
    if selection.has("discovery") and transport.agent_span is None:
        return DISCOVERY_GROUP, DISCOVERY_PORT
    return transport.host, transport.port
