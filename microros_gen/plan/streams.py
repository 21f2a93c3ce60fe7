# SPDX-License-Identifier: Apache-2.0
"""Sizes of the output streams: what the largest message of each needs, and no more.

Sizes are bytes of a whole datagram for a session id of 0x80 and above (OMG DDS-XRCE 1.0, 8.3.2: a header of
four bytes, each submessage aligned to four).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.model.application import Application

MESSAGE_HEADER = 4
SUBMESSAGE_HEADER = 4
OBJECT_PREFIX = 4  # request id and object id
WRITE_DATA_OVERHEAD = MESSAGE_HEADER + SUBMESSAGE_HEADER + OBJECT_PREFIX
# The largest message of the agent to a client that only writes is INFO with two locators (52 bytes).
WRITE_SIDE_INPUT = 64
# One Ethernet frame: larger datagrams are fragmented by IP, which small stacks drop.
DEFAULT_MTU = {"udp": 1472, "tcp": 1460, "serial": 512, "custom": 512}
DEFAULT_HISTORY = 4
# OMG DDS-XRCE window of the public agent (xrce: RELIABLE_STREAM_DEPTH).
LARGEST_HISTORY = 16


@dataclass(frozen=True)
class Written:
    """One kind of message that is written: where it was declared, its largest body, and on which streams."""

    label: str
    max_encoded_size: int
    reliable: bool
    best_effort: bool
    span: Span | None = None
    hint: str = ""


@dataclass(frozen=True)
class StreamPlan:
    """Bytes of each stream's storage; 0 or no slots where a stream is not needed."""

    mtu: int
    best_effort_size: int
    reliable_slots: int
    reliable_slot_size: int
    input_size: int

    @property
    def ram(self) -> int:
        """Bytes of all buffers together."""
        return self.best_effort_size + self.reliable_slots * self.reliable_slot_size + self.input_size


@dataclass(frozen=True)
class CreateNames:
    """Longest names that a CREATE carries, in characters."""

    participant: int
    topic: int
    type: int


def create_size(names: CreateNames) -> int:
    """Return the size of the largest CREATE datagram with binary representation (OMG DDS-XRCE 1.0, 8.3.5)."""
    fixed = 12  # request id, object id, kind, format, padding, length
    participant = 8 + names.participant + 1
    topic = _align4(4 + names.topic + 1 + 2) + 4 + names.type + 1
    data_writer = 14
    blob = max(participant, topic, data_writer)
    return _align4(MESSAGE_HEADER + SUBMESSAGE_HEADER + fixed + blob + 1 + 2)


def plan_streams(
    application: Application,
    transport: str,
    written: Iterable[Written],
    creates: CreateNames | None,
    diagnostics: Diagnostics,
) -> StreamPlan:
    """Size the streams; a message that cannot fit its stream is an error with the number that would do.

    `transport` is the selected one. `creates` is None where the client creates nothing (entities: preconfigured).
    """
    messages = tuple(written)
    ceiling = application.transport.mtu or DEFAULT_MTU[transport]
    for message in messages:
        _check_fits(message, ceiling, application, diagnostics)
    create = create_size(creates) if creates else 0
    if create > ceiling:
        diagnostics.error(
            f"the longest CREATE message takes {create} bytes and transport.mtu is {ceiling}",
            application.transport.mtu_span or application.transport.span,
            f"Set transport.mtu: {create}, or shorten the longest topic name",
        )
    best_effort = max([create, *(_datagram(m) for m in messages if m.best_effort)], default=0)
    reliable = max((_datagram(m) for m in messages if m.reliable), default=0)
    slots = application.pools.get("history", DEFAULT_HISTORY) if reliable else 0
    return StreamPlan(max(best_effort, reliable), best_effort, slots, reliable, WRITE_SIDE_INPUT)


def _check_fits(message: Written, ceiling: int, application: Application, diagnostics: Diagnostics) -> None:
    size = _datagram(message)
    if size <= ceiling:
        return
    what = "transport.mtu is" if application.transport.mtu else "without transport.mtu a datagram holds"
    raise_to = f"Set transport.mtu: {size}"
    diagnostics.error(
        f"{message.label} takes up to {size} bytes in its stream and {what} {ceiling}",
        message.span or application.transport.mtu_span or application.transport.span,
        f"{raise_to}, or lower its limits{message.hint}",
    )


def _datagram(message: Written) -> int:
    return _align4(WRITE_DATA_OVERHEAD + message.max_encoded_size)


def _align4(size: int) -> int:
    return (size + 3) & ~3
