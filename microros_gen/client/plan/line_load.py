# SPDX-License-Identifier: Apache-2.0
"""What the publishers with a rate need of the line, against what it carries.

Each message is the largest under the limits. On a serial line it is in frames, with ten bits for each byte, and one
byte in 32 is stuffed: four times as many as of random ones. On CAN it has every stuff bit that is possible. HEARTBEAT
messages of the reliable stream are on top, and the ACKNACK messages of the agent where it sends on the same bus.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction

from microros_gen.application.model import Application, EndpointDecl
from microros_gen.client.plan.creation import MESSAGE_HEADER, SUBMESSAGE_HEADER
from microros_gen.client.plan.declared import declarations, full_name
from microros_gen.client.plan.line_media import MOST_RATE, Medium
from microros_gen.client.plan.streams import FRAGMENT_HEADER, OBJECT_PREFIX, WRITE_DATA_OVERHEAD, Written
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.records import dataclass

HEARTBEAT_SIZE = 13
"""Bytes of a HEARTBEAT message; an ACKNACK message has as many."""
_SECOND_US = 1_000_000


@dataclass(frozen=True)
class RatedPublisher:
    """A publisher with a rate: at most one sample in `interval_us`.

    `messages`: sizes of the messages of the session that carry one sample, several where it goes in fragments.
    `rate_span`: where the rate is written.
    """

    topic: str
    reliable: bool
    interval_us: Fraction
    messages: tuple[int, ...]
    rate_span: Span | None

    def sample(self, medium: Medium) -> int:
        """Return what one sample takes, with the ACKNACK messages of the agent where they count."""
        acknowledged = len(self.messages) if medium.shared and self.reliable else 0
        return sum(map(medium.usual, self.messages)) + acknowledged * medium.usual(HEARTBEAT_SIZE)

    def load(self, medium: Medium) -> Fraction:
        """Return what it takes in a second."""
        return self.sample(medium) * _SECOND_US / self.interval_us


@dataclass(frozen=True)
class LineLoad:
    """`publishers` have a rate, `others` publishers none. The unit of loads is that of the medium.

    `heartbeat_ms`: the shortest time between two HEARTBEAT messages, which the reliable stream sends. `answers`:
    ACKNACK messages in a second that go the same way, to the other end.
    """

    publishers: tuple[RatedPublisher, ...]
    others: int
    medium: Medium
    heartbeat_ms: int
    answers: Fraction = Fraction(0)

    @property
    def heartbeats(self) -> Fraction:
        """Load of HEARTBEAT messages, and of answers that count; 0 where no publisher with a rate is reliable."""
        if not any(publisher.reliable for publisher in self.publishers):
            return Fraction(0)
        each = self.medium.usual(HEARTBEAT_SIZE) * (2 if self.medium.shared else 1)
        return Fraction(each * 1000, self.heartbeat_ms)

    @property
    def acknowledgments(self) -> Fraction:
        """Load of ACKNACK messages to the other end."""
        return self.medium.usual(HEARTBEAT_SIZE) * self.answers

    @property
    def load(self) -> Fraction:
        """Load of all of them."""
        return sum((p.load(self.medium) for p in self.publishers), self.heartbeats + self.acknowledgments)

    @property
    def parts(self) -> str:
        """What each publisher, HEARTBEAT and ACKNACK messages need."""
        loads = [(p.topic, p.load(self.medium)) for p in self.publishers]
        loads += [("HEARTBEAT", self.heartbeats), ("ACKNACK", self.acknowledgments)]
        return ", ".join(f"{name} {math.ceil(load)}" for name, load in loads if load)

    @property
    def most(self) -> Fraction:
        """Load of a serial line if every byte of a frame had to be stuffed."""
        most = self.medium.most
        beats = Fraction(most(HEARTBEAT_SIZE) * 1000, self.heartbeat_ms) if self.heartbeats else Fraction(0)
        frames = (sum(map(most, p.messages)) * _SECOND_US / p.interval_us for p in self.publishers)
        return sum(frames, beats)

    @property
    def fits(self) -> bool:
        """Whether the line carries all of them, as far as it is known."""
        return self.medium.capacity is None or self.load <= self.medium.capacity

    @property
    def text(self) -> str:
        """What is needed, and of how much."""
        capacity = self.medium.capacity
        needed = f"{math.ceil(self.load)} {self.medium.unit}"
        return needed if capacity is None else f"{needed} of {math.floor(capacity)}"

    @property
    def why(self) -> str:
        """What it consists of."""
        shown = "the largest message times rate of " + ", ".join(p.topic for p in self.publishers)
        beats = f", and {math.ceil(self.heartbeats)} of HEARTBEAT" if self.heartbeats else ""
        serial = self.medium.kind == "serial"
        stuffed = f"; {math.ceil(self.most)} if every byte were stuffed" if serial else ""
        others = f"; publishers without a rate: {self.others}" if self.others else ""
        return f"{shown}{beats}{stuffed}{others}"


def plan_line_load(
    application: Application,
    written: Sequence[Written],
    mtu: int,
    medium: Medium,
    heartbeat_ms: Callable[[int | None], int],
    diagnostics: Diagnostics,
) -> LineLoad | None:
    """Return what the publishers with a rate need; None without such. More than the line carries is an error.

    `written`: what each declared publisher writes, in their order. `heartbeat_ms`: the time between two HEARTBEAT
    messages where the line has a rate.
    """
    declared = zip(declarations(application, "publisher"), written, strict=False)
    publishers, others = [], 0
    for (_, node, endpoint), message in declared if application.nodes else ():
        topic = full_name(node, endpoint)
        if endpoint.interval_us is None:
            others += endpoint.exists_at_agent
            continue
        _check_deadline(endpoint, topic, diagnostics)
        if not endpoint.exists_at_agent:
            if endpoint.peer == "never":
                diagnostics.warning(
                    f"'rate' of {topic} has no effect: its messages use no line",
                    endpoint.rate_span,
                    "Remove it",
                    id="MG-7131",
                )
            continue
        sizes = message_sizes(message.max_encoded_size, mtu)
        publishers.append(
            RatedPublisher(topic, message.reliable, endpoint.interval_us, sizes, endpoint.rate_span)
        )
    if not publishers:
        if application.transport.bitrate is not None and not application.links:
            diagnostics.warning(
                "'transport.bitrate' has no effect: no publisher has a rate that is compared with it",
                application.spans.get("transport.bitrate"),
                "Write `rate: 10 Hz` at publishers, or remove it",
                id="MG-7133",
            )
        return None
    load = LineLoad(tuple(publishers), others, medium, heartbeat_ms(medium.rate))
    _check_capacity(load, heartbeat_ms, diagnostics)
    return load


def message_sizes(body: int, mtu: int) -> tuple[int, ...]:
    """Return the sizes of the messages that carry a body of CDR, each at most `mtu` bytes."""
    whole = WRITE_DATA_OVERHEAD + body
    if whole <= mtu:
        return (whole,)
    header = MESSAGE_HEADER + FRAGMENT_HEADER
    count, rest = divmod(SUBMESSAGE_HEADER + OBJECT_PREFIX + body, mtu - header)
    return (mtu,) * count + ((header + rest,) if rest else ())


def rate_text(rate: Fraction) -> str:
    """Return a rate as the application file has it, rounded down to a thousandth."""
    thousandths = math.floor(rate * 1000)
    whole, part = divmod(thousandths, 1000)
    return f"{whole}.{part:03}".rstrip("0").rstrip(".") + " Hz"


def _check_deadline(endpoint: EndpointDecl, topic: str, diagnostics: Diagnostics) -> None:
    deadline, interval = endpoint.qos.deadline_ms, endpoint.interval_us
    if deadline and interval is not None and interval > deadline * 1000:
        rate = rate_text(Fraction(math.ceil(Fraction(1_000_000, deadline)), 1000))
        diagnostics.error(
            f"{topic} is published at {rate_text(_SECOND_US / interval)} and promises a deadline of {deadline} ms",
            endpoint.rate_span,
            f"Write a rate of {rate} or more, or a later deadline",
            id="MG-7132",
        )


def _check_capacity(
    load: LineLoad, heartbeat_ms: Callable[[int | None], int], diagnostics: Diagnostics
) -> None:
    medium = load.medium
    if load.fits or medium.capacity is None:
        return
    largest = max(load.publishers, key=lambda publisher: publisher.load(medium))
    diagnostics.error(
        f"the publishers with a rate need {math.ceil(load.load)} {medium.unit}, and the line carries"
        f" {math.floor(medium.capacity)} with `{medium.key}: {medium.rate}` ({load.parts})",
        largest.rate_span,
        _hint(load, largest, fitting_rate_of_line(load, heartbeat_ms)),
        id="MG-7130",
    )


def _hint(load: LineLoad, largest: RatedPublisher, bits: int) -> str:
    ways = [f"`rate: {rate}` at {largest.topic}"] if (rate := fitting_rate(load, largest)) else []
    possible = bits <= MOST_RATE[load.medium.kind]
    ways += [f"`transport: {{{load.medium.key}: {bits}}}`"] if possible else []
    return (
        f"Write {' or '.join(ways)}, or lower the limits of the messages" if ways else "Lower several rates"
    )


def fitting_rate(load: LineLoad, publisher: RatedPublisher) -> str | None:
    """Return the largest rate of a publisher with which the line carries all; None where the others need all of it.

    It is a whole number of Hz where that is possible, else of thousandths.
    """
    assert load.medium.capacity is not None
    left = load.medium.capacity - (load.load - publisher.load(load.medium))
    rate = left / publisher.sample(load.medium)
    rate = Fraction(math.floor(rate)) if rate >= 1 else rate
    return rate_text(rate) if rate * 1000 >= 1 else None


def fitting_rate_of_line(
    load: LineLoad,
    heartbeat_ms: Callable[[int | None], int],
    answers: Callable[[int | None], Fraction] = lambda rate: Fraction(0),
) -> int:
    """Return the least bit rate of the line that carries all: a usual one, or the number itself above them.

    `heartbeat_ms`: the time between two HEARTBEAT messages at a rate, which is longer on a slow serial line. `answers`:
    ACKNACK messages in a second at a rate.
    """

    def at(rate: int) -> LineLoad:
        medium = replace(load.medium, rate=rate)
        return replace(load, medium=medium, heartbeat_ms=heartbeat_ms(rate), answers=answers(rate))

    for rate in load.medium.rates:
        if at(rate).fits:
            return rate
    rate = load.medium.rates[-1]
    while not (other := at(rate)).fits:
        assert other.medium.capacity is not None
        rate = max(math.ceil(rate * other.load / other.medium.capacity), rate + 1)
    return rate
