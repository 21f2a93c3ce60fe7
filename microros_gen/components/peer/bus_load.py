# SPDX-License-Identifier: Apache-2.0
"""What the messages with a rate need of a CAN bus: those of all its boards, to each other and to their agents.

All of them share the bus. Boards that are not in the system file are not known.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction

from microros_gen.application.model import SessionTimes
from microros_gen.application.system_decl import BusSender, Link
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.line_load import LineLoad, RatedPublisher, message_sizes, rate_text
from microros_gen.client.plan.line_media import BIT_RATES, MOST_RATE, Medium
from microros_gen.client.plan.session_times import plan_times
from microros_gen.client.plan.streams import WRITE_DATA_OVERHEAD, WRITE_SIDE_INPUT
from microros_gen.components.peer.check import OwnEnd, matches
from microros_gen.components.peer.check_limits import bus_body
from microros_gen.components.peer.fragments import sent_messages
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.records import dataclass

_SECOND_US = 1_000_000


@dataclass(frozen=True)
class BusLine:
    """What one board sends to another one or to its agent, as `name` says; `board` is the sender, empty: this board."""

    name: str
    board: str
    line: LineLoad


@dataclass(frozen=True)
class BusLoad:
    """The load of a bus, bits/s: `lines` of all boards on it that are known."""

    device: str
    medium: Medium
    lines: tuple[BusLine, ...]

    @property
    def load(self) -> Fraction:
        """Return the bits in a second."""
        return sum((each.line.load for each in self.lines), Fraction(0))

    @property
    def parts(self) -> str:
        """Return what each direction needs, and for what."""
        return "; ".join(f"{each.name}: {each.line.parts}" for each in self.lines)

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
    loads = []
    medium = Medium("canfd", context.application.transport.bitrate)
    links = [link for link in context.application.links if link.can is not None]
    for device in dict.fromkeys(link.own.name for link in links):
        at_device = [link for link in links if link.own.name == device]
        rated = tuple(
            each for each in _lines(device, at_device, context, ends, medium) if each.line.publishers
        )
        if rated:
            loads.append(BusLoad(device, medium, rated))
            _check_capacity(loads[-1], at_device[0].span, diagnostics)
    return tuple(loads)


def _lines(
    device: str, links: list[Link], context: PlanContext, ends: tuple[OwnEnd, ...], medium: Medium
) -> Iterator[BusLine]:
    for link in links:
        yield BusLine(f"to {link.board}", "", _sent(link, context, ends, medium))
        yield BusLine(f"from {link.board}", link.board, _received(link, context, ends, medium))
    if context.line is not None and device == context.application.transport.can_device:
        yield BusLine("agent", "", context.line)
    for sender in context.application.bus_senders:
        if sender.device == device:
            receiver = "its agent" if sender.receiver is None else sender.receiver
            yield BusLine(f"{sender.board} to {receiver}", sender.board, _of_others(sender, medium))


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
    return LineLoad(tuple(rated), 0, medium, _heartbeat_ms(link.round_trip, link.heartbeat))


def _of_others(sender: BusSender, medium: Medium) -> LineLoad:
    """Return what another board sends, with the answers, and no part of it to this board."""
    rated = tuple(
        RatedPublisher(
            end.topic,
            end.reliability == "reliable",
            end.interval_us or Fraction(0),
            message_sizes(bus_body(end, sender), sender.mtu),
            end.rate_span,
        )
        for end in sender.publishers
    )
    return LineLoad(rated, 0, medium, _heartbeat_ms(sender.round_trip, sender.heartbeat))


def _heartbeat_ms(round_trip: int | None, heartbeat: int | None) -> int:
    """Return the time between two HEARTBEAT messages of another board on a bus, from what its `session:` says."""
    settings = SessionTimes(round_trip=round_trip, heartbeat=heartbeat)
    return plan_times(settings, None, WRITE_DATA_OVERHEAD, WRITE_SIDE_INPUT).heartbeat_period_ms


def _rated(
    topic: str, own: OwnEnd, interval: Fraction | None, size: int, link: Link, reliability: str = ""
) -> RatedPublisher:
    assert interval is not None
    reliable = (reliability or own.end.reliability) == "reliable"
    return RatedPublisher(topic, reliable, interval, sent_messages(size, link), own.endpoint.rate_span)


def _check_capacity(bus: BusLoad, span: Span | None, diagnostics: Diagnostics) -> None:
    """Report a bus that does not carry everything; `span`: a link, where this board publishes nothing with a rate."""
    capacity = bus.medium.capacity
    if capacity is None or bus.load <= capacity:
        return
    own = _largest(bus, of_this_board=True)
    rate = _fitting(bus, capacity, own) or _fitting(bus, capacity, _largest(bus, of_this_board=False))
    ways = [rate] if rate else []
    bits = next((each for each in BIT_RATES if each >= bus.load), math.ceil(bus.load))
    ways += [f"`transport: {{bitrate: {bits}}}` at all boards"] if bits <= MOST_RATE["canfd"] else []
    diagnostics.error(
        f"the messages with a rate need {math.ceil(bus.load)} bit/s on the bus '{bus.device}', and it carries "
        f"{bus.medium.rate} ({bus.parts})",
        own.span if own is not None else span,
        f"Write {' or '.join(ways)}, or lower the limits of the messages" if ways else "Lower several rates",
        id="MG-7269",
    )


@dataclass(frozen=True)
class _Publisher:
    """A publisher of `board` (empty: this one), and the bits of one sample to all boards and the agent that get it."""

    board: str
    topic: str
    interval_us: Fraction
    span: Span | None
    sample: int

    @property
    def load(self) -> Fraction:
        """Return the bits of its samples, in proportion to those of others."""
        return self.sample / self.interval_us


def _largest(bus: BusLoad, of_this_board: bool) -> _Publisher | None:
    """Return the publisher with the largest load; `of_this_board`: only those are looked at."""
    found: dict[tuple[str, str, Fraction], _Publisher] = {}
    for each in bus.lines:
        for publisher in each.line.publishers if not (each.board and of_this_board) else ():
            key = each.board, publisher.topic, publisher.interval_us
            before = found[key].sample if key in found else 0
            found[key] = _Publisher(*key, publisher.rate_span, before + publisher.sample(bus.medium))
    return max(found.values(), key=lambda publisher: publisher.load, default=None)


def _fitting(bus: BusLoad, capacity: Fraction, publisher: _Publisher | None) -> str:
    """Return the rate of a publisher with which the bus carries everything; empty: none does."""
    if publisher is None:
        return ""
    rate = (capacity - bus.load) / publisher.sample + _SECOND_US / publisher.interval_us
    rate = Fraction(math.floor(rate)) if rate >= 1 else rate
    where = f" of the board '{publisher.board}'" if publisher.board else ""
    return f"`rate: {rate_text(rate)}` at {publisher.topic}{where}" if rate * 1000 >= 1 else ""
