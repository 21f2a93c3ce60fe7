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
from microros_gen.plan.creation import MESSAGE_HEADER, SUBMESSAGE_HEADER

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
    """Bytes of each stream's storage; 0 or no slots where a stream is not needed.

    `creation_size`: of a request to create on the reliable stream.
    """

    mtu: int
    best_effort_size: int
    reliable_slots: int
    reliable_slot_size: int
    input_size: int
    creation_size: int = 0

    @property
    def ram(self) -> int:
        """Bytes of all buffers together."""
        reliable = self.reliable_slots * self.reliable_slot_size
        return self.best_effort_size + reliable + self.input_size + self.creation_size


def plan_streams(
    application: Application,
    transport: str,
    written: Iterable[Written],
    create: int,
    diagnostics: Diagnostics,
) -> StreamPlan:
    """Size the streams; a message that cannot fit its stream is an error with the number that would do.

    `transport` is the selected one. `create` is the size of the largest CREATE (plan/creation.py), 0 where the client
    creates nothing (entities: preconfigured). With `creation: reliable` it has storage of its own, and the reliable
    stream is there for it.
    """
    messages = tuple(written)
    ceiling = application.transport.mtu or DEFAULT_MTU[transport]
    for message in messages:
        _check_fits(message, ceiling, application, diagnostics)
    if create > ceiling:
        diagnostics.error(
            f"the longest CREATE message takes {create} bytes and transport.mtu is {ceiling}",
            application.transport.mtu_span or application.transport.span,
            f"Set transport.mtu: {create}, or shorten the longest topic name",
        )
    best_effort = max((_datagram(m) for m in messages if m.best_effort), default=0)
    reliable = max((_datagram(m) for m in messages if m.reliable), default=0)
    slots = application.pools.get("history", DEFAULT_HISTORY) if reliable else 0
    creation = create if application.creation and application.creation.name == "reliable" else 0
    if not creation:
        best_effort = max(best_effort, create)
    elif not reliable:
        slots, reliable = 1, WRITE_DATA_OVERHEAD
    mtu = max(best_effort, reliable, create)
    return StreamPlan(mtu, best_effort, slots, reliable, WRITE_SIDE_INPUT, creation)


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
