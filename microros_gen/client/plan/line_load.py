# SPDX-License-Identifier: Apache-2.0
"""What the publishers with a rate need of the line, against what it carries.

Each message is the largest under the limits. On a serial line it is in frames, with ten bits for each byte, and one
byte in 32 is stuffed: four times as many as of random ones. The HEARTBEAT messages of the reliable stream come on top.
What the agent sends, its ACKNACK messages among it, goes the other way and does not count.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction

from microros_gen.application.model import Application, EndpointDecl
from microros_gen.client.plan.creation import MESSAGE_HEADER, SUBMESSAGE_HEADER
from microros_gen.client.plan.declared import declarations, full_name
from microros_gen.client.plan.session_times import LINE_BITS_PER_BYTE
from microros_gen.client.plan.streams import (
    FRAGMENT_HEADER,
    OBJECT_PREFIX,
    WRITE_DATA_OVERHEAD,
    Written,
    longest_frame,
    usual_frame,
)
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

HEARTBEAT_SIZE = 13
BAUD_RATES = (
    *(9600, 19_200, 38_400, 57_600, 115_200, 230_400, 460_800, 921_600),
    *(1_000_000, 1_500_000, 2_000_000, 3_000_000, 4_000_000),
)
"""Rates that adapters have; above them the rate is computed."""
MOST_BAUD = 12_000_000  # application.schema.json says it too
_SECOND_US = 1_000_000


@dataclass(frozen=True)
class RatedPublisher:
    """A publisher with a rate: at most one message in `interval_us`.

    `messages`: sizes of the messages of the session that carry one sample, several where it goes in fragments.
    """

    topic: str
    type: str
    reliable: bool
    interval_us: Fraction
    messages: tuple[int, ...]
    endpoint: EndpointDecl

    def bytes(self, framed: bool) -> int:
        """Return the bytes of one message on the line; `framed`: in frames of a serial line."""
        return sum(usual_frame(size) if framed else size for size in self.messages)

    def load(self, framed: bool) -> Fraction:
        """Return the bytes per second."""
        return self.bytes(framed) * _SECOND_US / self.interval_us

    @property
    def rate(self) -> str:
        """The rate as it is written: `100 Hz`."""
        return rate_text(_SECOND_US / self.interval_us)


@dataclass(frozen=True)
class LineLoad:
    """`publishers` have a rate, `others` publishers none. `baud`: of a serial line, else None.

    `heartbeat_ms`: the shortest time between two HEARTBEAT messages, which the reliable stream sends.
    """

    publishers: tuple[RatedPublisher, ...]
    others: int
    baud: int | None
    heartbeat_ms: int

    @property
    def framed(self) -> bool:
        """Whether messages are in frames of a serial line."""
        return self.baud is not None

    @property
    def heartbeats(self) -> Fraction:
        """Bytes per second of HEARTBEAT messages; 0 where no publisher with a rate is reliable."""
        if not any(publisher.reliable for publisher in self.publishers):
            return Fraction(0)
        size = usual_frame(HEARTBEAT_SIZE) if self.framed else HEARTBEAT_SIZE
        return Fraction(size * 1000, self.heartbeat_ms)

    @property
    def load(self) -> Fraction:
        """Bytes per second of all of them."""
        return sum((p.load(self.framed) for p in self.publishers), self.heartbeats)

    @property
    def most(self) -> Fraction:
        """Bytes per second if every byte of a frame had to be stuffed."""
        beats = Fraction(longest_frame(HEARTBEAT_SIZE) * 1000, self.heartbeat_ms) if self.heartbeats else 0
        frames = (sum(map(longest_frame, p.messages)) * _SECOND_US / p.interval_us for p in self.publishers)
        return sum(frames, Fraction(beats))

    @property
    def capacity(self) -> Fraction | None:
        """Bytes per second that the line carries; None: nothing is known of it."""
        return None if self.baud is None else Fraction(self.baud, LINE_BITS_PER_BYTE)

    @property
    def fits(self) -> bool:
        """Whether the line carries all of them, as far as it is known."""
        return self.capacity is None or self.load <= self.capacity

    @property
    def text(self) -> str:
        """What is needed, and of how much."""
        needed = f"{math.ceil(self.load)} bytes/s"
        return needed if self.capacity is None else f"{needed} of {math.floor(self.capacity)}"

    @property
    def why(self) -> str:
        """What it consists of."""
        shown = "the largest message times rate of " + ", ".join(p.topic for p in self.publishers)
        beats = f", and {math.ceil(self.heartbeats)} of HEARTBEAT" if self.heartbeats else ""
        stuffed = f"; {math.ceil(self.most)} if every byte were stuffed" if self.framed else ""
        others = f"; publishers without a rate: {self.others}" if self.others else ""
        return f"{shown}{beats}{stuffed}{others}"


def plan_line_load(
    application: Application,
    written: Sequence[Written],
    mtu: int,
    heartbeat_ms: Callable[[int | None], int],
    baud: int | None,
    diagnostics: Diagnostics,
) -> LineLoad | None:
    """Return what the publishers with a rate need; None without such. More than the line carries is an error.

    `written`: what each declared publisher writes, in their order. `baud`: of the serial line, or None; `heartbeat_ms`:
    the time between two HEARTBEAT messages at a baud rate.
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
            diagnostics.warning(
                f"'rate' of {topic} has no effect: its messages do not use the line to the agent",
                endpoint.rate_span,
                "Remove it",
                id="MG-7131",
            )
            continue
        sizes = message_sizes(message.max_encoded_size, mtu)
        publishers.append(
            RatedPublisher(topic, endpoint.type, message.reliable, endpoint.interval_us, sizes, endpoint)
        )
    if not publishers:
        return None
    load = LineLoad(tuple(publishers), others, baud, heartbeat_ms(baud))
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


def _check_capacity(load: LineLoad, heartbeat_ms: Callable[[int], int], diagnostics: Diagnostics) -> None:
    if load.fits or load.capacity is None:
        return
    needed, carried = math.ceil(load.load), math.floor(load.capacity)
    largest = max(load.publishers, key=lambda publisher: publisher.load(load.framed))
    parts = [f"{p.topic} {math.ceil(p.load(load.framed))}" for p in load.publishers]
    parts += [f"HEARTBEAT {math.ceil(load.heartbeats)}"] if load.heartbeats else []
    diagnostics.error(
        f"the publishers with a rate need {needed} bytes per second, and the line carries {carried} at {load.baud} baud"
        f" ({', '.join(parts)})",
        largest.endpoint.rate_span,
        _hint(load, largest, fitting_baud(load, heartbeat_ms)),
        id="MG-7130",
    )


def _hint(load: LineLoad, largest: RatedPublisher, baud: int) -> str:
    ways = [f"`rate: {rate}` at {largest.topic}"] if (rate := fitting_rate(load, largest)) else []
    ways += [f"`transport: {{baud: {baud}}}`"] if baud <= MOST_BAUD else []
    return (
        f"Write {' or '.join(ways)}, or lower the limits of the messages" if ways else "Lower several rates"
    )


def fitting_rate(load: LineLoad, publisher: RatedPublisher) -> str | None:
    """Return the largest rate of a publisher with which the line carries all; None where the others need all of it.

    It is a whole number of Hz where that is possible, else of thousandths.
    """
    assert load.capacity is not None
    left = load.capacity - (load.load - publisher.load(load.framed))
    rate = left / publisher.bytes(load.framed)
    rate = Fraction(math.floor(rate)) if rate >= 1 else rate
    return rate_text(rate) if rate * 1000 >= 1 else None


def fitting_baud(load: LineLoad, heartbeat_ms: Callable[[int], int]) -> int:
    """Return the least baud rate that carries all: of BAUD_RATES, or the number itself above them.

    `heartbeat_ms`: the time between two HEARTBEAT messages at a baud rate, which is longer on a slow line.
    """
    for baud in BAUD_RATES:
        other = replace(load, baud=baud, heartbeat_ms=heartbeat_ms(baud))
        if other.fits:
            return baud
    while not other.fits:
        assert other.baud is not None
        needed = max(math.ceil(other.load * LINE_BITS_PER_BYTE), other.baud + 1)
        other = replace(load, baud=needed, heartbeat_ms=heartbeat_ms(needed))
    assert other.baud is not None
    return other.baud
