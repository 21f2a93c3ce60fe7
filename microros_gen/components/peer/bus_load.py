# SPDX-License-Identifier: Apache-2.0
"""What the messages with a rate need of a CAN bus: those of a board, both ways on its links, and to its agent.

All of them share the bus. What two other boards exchange is not known to this one.
"""

from __future__ import annotations

import math
from fractions import Fraction

from microros_gen.application.model import SessionTimes
from microros_gen.application.system_decl import Link
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.line_load import LineLoad, RatedPublisher, rate_text
from microros_gen.client.plan.line_media import BIT_RATES, MOST_RATE, Medium
from microros_gen.client.plan.session_times import plan_times
from microros_gen.client.plan.streams import WRITE_DATA_OVERHEAD, WRITE_SIDE_INPUT
from microros_gen.components.peer.check import OwnEnd, matches
from microros_gen.components.peer.fragments import sent_messages
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass


@dataclass(frozen=True)
class BusLoad:
    """The load of a bus: `lines` to and from the boards of the links, or the agent, each with its name. Bits/s."""

    device: str
    medium: Medium
    lines: tuple[tuple[str, LineLoad], ...]

    @property
    def load(self) -> Fraction:
        """Return the bits in a second."""
        return sum((line.load for _, line in self.lines), Fraction(0))

    @property
    def parts(self) -> str:
        """Return what each direction needs, and for what."""
        return "; ".join(f"{name}: {line.parts}" for name, line in self.lines)

    @property
    def shown(self) -> str:
        """Return what is needed, of how much, and what it consists of."""
        needed = f"{self.device} {math.ceil(self.load)} bit/s"
        if self.medium.capacity is None:
            return f"{needed} ({self.parts}); the application has no `bitrate`"
        return f"{needed} of {self.medium.rate} ({self.parts})"


def plan_bus_loads(
    context: PlanContext, ends: tuple[OwnEnd, ...], diagnostics: Diagnostics
) -> tuple[BusLoad, ...]:
    """Return the loads of the buses on which anything has a rate. More than a bus carries is an error."""
    transport, loads = context.application.transport, []
    medium = Medium("canfd", transport.bitrate)
    links = [link for link in context.application.links if link.can is not None]
    for device in dict.fromkeys(link.own.name for link in links):
        lines: list[tuple[str, LineLoad]] = []
        for link in (link for link in links if link.own.name == device):
            lines.append((f"to {link.board}", _sent(link, context, ends, medium)))
            lines.append((f"from {link.board}", _received(link, context, ends, medium)))
        if context.line is not None and device == transport.can_device:
            lines.append(("agent", context.line))
        rated = tuple((name, line) for name, line in lines if line.publishers)
        if rated:
            loads.append(BusLoad(device, medium, rated))
            _check_capacity(loads[-1], links[0], diagnostics)
    return tuple(loads)


def _sent(link: Link, context: PlanContext, ends: tuple[OwnEnd, ...], medium: Medium) -> LineLoad:
    """Return what this board publishes, with the answers of the other one."""
    rated = [
        _rated(own.end.topic, own, own.endpoint.interval_us, own.sent_size(context), link)
        for own in ends
        if own.sends and own.endpoint.interval_us is not None and any(matches(own, link))
    ]
    return LineLoad(tuple(rated), 0, medium, context.runtime.times.heartbeat_period_ms)


def _received(link: Link, context: PlanContext, ends: tuple[OwnEnd, ...], medium: Medium) -> LineLoad:
    """Return what the other board publishes, with the answers of this one."""
    rated = [
        _rated(end.topic, own, end.interval_us, own.taken_size(end, link, context), link, end.reliability)
        for own in ends
        for end in matches(own, link)
        if end.kind == "publisher" and end.interval_us is not None
    ]
    settings = SessionTimes(round_trip=link.round_trip, heartbeat=link.heartbeat)
    beat = plan_times(settings, None, WRITE_DATA_OVERHEAD, WRITE_SIDE_INPUT).heartbeat_period_ms
    return LineLoad(tuple(rated), 0, medium, beat)


def _rated(
    topic: str, own: OwnEnd, interval: Fraction | None, size: int, link: Link, reliability: str = ""
) -> RatedPublisher:
    assert interval is not None
    reliable = (reliability or own.end.reliability) == "reliable"
    return RatedPublisher(topic, reliable, interval, sent_messages(size, link), own.endpoint)


def _check_capacity(bus: BusLoad, link: Link, diagnostics: Diagnostics) -> None:
    capacity = bus.medium.capacity
    if capacity is None or bus.load <= capacity:
        return
    own = [p for name, line in bus.lines if not name.startswith("from ") for p in line.publishers]
    largest = max(own, key=lambda publisher: publisher.load(bus.medium), default=None)
    ways = []
    if largest is not None:
        left = capacity - bus.load + largest.load(bus.medium)
        rate = left / largest.sample(bus.medium)
        rate = Fraction(math.floor(rate)) if rate >= 1 else rate
        ways += [f"`rate: {rate_text(rate)}` at {largest.topic}"] if rate * 1000 >= 1 else []
    bits = next((each for each in BIT_RATES if each >= bus.load), math.ceil(bus.load))
    ways += [f"`transport: {{bitrate: {bits}}}` at all boards"] if bits <= MOST_RATE["canfd"] else []
    diagnostics.error(
        f"the messages with a rate need {math.ceil(bus.load)} bit/s on the bus '{bus.device}', and it carries "
        f"{bus.medium.rate} ({bus.parts})",
        largest.endpoint.rate_span if largest is not None else link.span,
        f"Write {' or '.join(ways)}, or lower the limits of the messages" if ways else "Lower several rates",
        id="MG-7269",
    )
