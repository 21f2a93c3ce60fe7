# SPDX-License-Identifier: Apache-2.0
"""What the publishers with a rate need of each link, against what a serial line carries.

A UART is full duplex: this board counts what it sends, the other board what comes back. A board also sends an ACKNACK
for each reliable message and each HEARTBEAT that it receives. Each byte of a frame counts as stuffed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

from microros_gen.application.model import SessionTimes
from microros_gen.application.system_decl import Link
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.line_load import LineLoad, RatedPublisher, fitting_rate, fitting_rate_of_line
from microros_gen.client.plan.line_media import MOST_RATE, Medium
from microros_gen.client.plan.session_times import plan_times
from microros_gen.client.plan.streams import WRITE_DATA_OVERHEAD, WRITE_SIDE_INPUT
from microros_gen.components.peer.check import OwnEnd, matches
from microros_gen.components.peer.fragments import sent_messages
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

_SECOND_MS, _SECOND_US = 1000, 1_000_000

Answers = Callable[[int | None], Fraction]
"""ACKNACK messages of this board in a second, by the bit rate of the line."""


@dataclass(frozen=True)
class LinkLoad:
    """The load of a link with `board`, in the direction to it."""

    board: str
    line: LineLoad

    @property
    def shown(self) -> str:
        """Return what is needed, of how much, and what it consists of."""
        if self.line.medium.capacity is None:
            return f"{self.board} {self.line.text} ({self.line.parts}); the rate of a UDP link is not known"
        return f"{self.board} {self.line.text} if every byte is stuffed ({self.line.parts})"


def plan_loads(
    context: PlanContext, ends: tuple[OwnEnd, ...], diagnostics: Diagnostics
) -> tuple[LinkLoad, ...]:
    """Return the loads of the links on which anything has a rate. More than a line carries is an error.

    Those over CAN FD share a bus: bus_load.py.
    """
    loads = []
    for link in (link for link in context.application.links if link.can is None):
        load, answers = _load(link, context, ends)
        if load.publishers or load.answers:
            _check_capacity(load, answers, link, context, diagnostics)
            loads.append(LinkLoad(link.board, load))
    return tuple(loads)


def _load(link: Link, context: PlanContext, ends: tuple[OwnEnd, ...]) -> tuple[LineLoad, Answers]:
    """Return the load of a link, and its ACKNACK messages at other rates of the line."""
    rated, others = [], 0
    for own in (own for own in ends if own.sends and any(matches(own, link))):
        if own.endpoint.interval_us is None:
            others += 1
            continue
        sizes, reliable = sent_messages(own.sent_size(context), link), own.end.reliability == "reliable"
        interval, span = own.endpoint.interval_us, own.endpoint.rate_span
        rated.append(RatedPublisher(own.end.topic, reliable, interval, sizes, span))
    baud = context.application.transport.baud if link.kind == "serial" else None
    medium = Medium(link.kind, baud, stuffed=True)
    answers = _answers(link, context, ends)
    beat = context.runtime.times.heartbeat_period_ms
    return LineLoad(tuple(rated), others, medium, beat, answers(baud)), answers


def _answers(link: Link, context: PlanContext, ends: tuple[OwnEnd, ...]) -> Answers:
    """Return how many ACKNACK messages the messages with a rate of the other board need, one for each fragment.

    The time between its HEARTBEAT messages is at least that of the smallest message and input buffer on a line.
    """
    subscribed = {own.key: own for own in ends if own.end.kind == "subscription"}
    messages = Fraction(0)
    for end in link.ends:
        own = subscribed.get((end.domain_id, end.topic))
        if own is not None and end.kind == "publisher" and end.reliability == "reliable" and end.interval_us:
            count = len(sent_messages(own.taken_size(end, link, context), link))
            messages += count * _SECOND_US / end.interval_us
    settings = SessionTimes(round_trip=link.round_trip, heartbeat=link.heartbeat)

    def at(baud: int | None) -> Fraction:
        beat = plan_times(settings, baud, WRITE_DATA_OVERHEAD, WRITE_SIDE_INPUT).heartbeat_period_ms
        return messages + Fraction(_SECOND_MS, beat) if messages else Fraction(0)

    return at


def _check_capacity(
    load: LineLoad, answers: Answers, link: Link, context: PlanContext, diagnostics: Diagnostics
) -> None:
    if load.fits or load.medium.capacity is None:
        return
    largest = max(load.publishers, key=lambda publisher: publisher.load(load.medium), default=None)
    rate = fitting_rate(load, largest) if largest is not None else None
    application, runtime = context.application, context.runtime

    def heartbeat_ms(baud: int | None) -> int:
        return plan_times(
            application.times, baud, runtime.streams.mtu, runtime.input.size
        ).heartbeat_period_ms

    bits = fitting_rate_of_line(load, heartbeat_ms, answers)
    ways = [f"`rate: {rate}` at {largest.topic}"] if largest is not None and rate is not None else []
    ways += [f"`transport: {{baud: {bits}}}` at both boards"] if bits <= MOST_RATE["serial"] else []
    diagnostics.error(
        f"the messages with a rate need {math.ceil(load.load)} bytes/s on the line to the board '{link.board}', and it"
        f" carries {math.floor(load.medium.capacity)} with `baud: {load.medium.rate}` ({load.parts})",
        largest.rate_span if largest is not None else link.span,
        f"Write {' or '.join(ways)}, or lower the limits of the messages" if ways else "Lower several rates",
        id="MG-7208",
    )
