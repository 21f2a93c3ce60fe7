# SPDX-License-Identifier: Apache-2.0
"""Sizes of the streams: what the largest message of each needs, and no more, unless the application asks for more.

Sizes are bytes of a whole datagram for a session id of 0x80 and above (OMG DDS-XRCE 1.0, 8.3.2: a header of
four bytes, each submessage aligned to four).
"""

from __future__ import annotations

from collections.abc import Iterable

from microros_gen.application.model import Application
from microros_gen.client.plan.creation import MESSAGE_HEADER, SUBMESSAGE_HEADER, most_in_fragments
from microros_gen.client.plan.history import default_history, input_slots, output_slots
from microros_gen.client.plan.transport_sizes import (
    FRAGMENTS_PER_SAMPLE,
    carried,
    default_mtu,
    largest_mtu,
    mtu_is,
)
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.records import dataclass

OBJECT_PREFIX = 4  # request id and object id
WRITE_DATA_OVERHEAD = MESSAGE_HEADER + SUBMESSAGE_HEADER + OBJECT_PREFIX
# The largest message of the agent to a client that only writes is INFO with two locators (52 bytes).
WRITE_SIDE_INPUT = 64
# A frame around a message on a serial line: flag, addresses, length, CRC; all but the flag may be stuffed, and are
# then twice as long (OMG DDS-XRCE 1.0, annex C). Of random bytes one in 128 is.
_FRAME_FLAG = 1
_FRAME_REST = 6
_STUFFED_SHARE = 32  # a reserve four times that
_LINES = ("serial", "custom")  # a custom transport may use the line of a board
# The longest of what a session sends besides its streams: READ_DATA, CREATE_CLIENT; the latter with its property.
_SESSION_MESSAGE = 24
_SESSION_MESSAGE_HARD = 54
LEAST_FRAGMENT = 256
# What a streamed endpoint receives at a time, at least.
STREAMED_FRAGMENT = LEAST_FRAGMENT - WRITE_DATA_OVERHEAD
# A slot in the input buffer has to save so many bytes: it costs some hundred of flash.
LEAST_LENT = 256
# A message that the line's interrupt takes from its stream has to save so many bytes, for the same reason.
LEAST_KEPT = 128
# In front of a message that goes in fragments: FRAGMENT's header, besides that of the message.
FRAGMENT_HEADER = 4
# The length of a submessage has 16 bits (OMG DDS-XRCE 1.0, 8.3.4); the whole submessage is counted in as many here.
LARGEST_BODY = 0xFFFF - SUBMESSAGE_HEADER - OBJECT_PREFIX


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
class Received:
    """What an endpoint receives: where it was declared, the largest DATA after the object's id, on which streams.

    `alone`: its queue has one place. Then memory counts more than the number of messages that a sample takes.
    `streamed`: it is taken piece by piece, however large it is; `max_size` is that of a piece.
    """

    label: str
    max_size: int
    reliable: bool
    best_effort: bool
    span: Span | None = None
    alone: bool = False
    streamed: bool = False

    @property
    def whole(self) -> int:
        """Bytes of the message that has all of it."""
        return _align4(WRITE_DATA_OVERHEAD + self.max_size)

    def largest_message(self, ceiling: int, fragments: int) -> int:
        """Return the bytes of the largest message that contains it or, where fragments are allowed, of one fragment."""
        if self.alone and self.reliable and not self.best_effort:
            ceiling = min(ceiling, max(LEAST_FRAGMENT, _align4(-(-self.whole // fragments))))
        return min(ceiling, self.whole)


@dataclass(frozen=True)
class StreamSizes:
    """Bytes of each stream's storage; 0 or no slots where a stream is not needed.

    `mtu`: the largest message that is sent. `fragments`: some reliable message is larger and is sent in fragments.
    `best_effort_slots`: messages that wait for the task of the session; 0: they are sent at once. `best_effort_places`:
    those, and one of the session itself where it creates entities on that stream.
    `creation_size`: of a request to create on the reliable stream, which goes in fragments (`creation_fragments`) where
    it is larger than the MTU. `reliable_input_slots`: messages of the agent's
    reliable stream that are held at a time; the one that is being handled is in the input buffer.
    `arrives_in_fragments`: some reliable DATA is larger than the input buffer; it is put together in the slot of its
    reader's queue. `input_size`: the largest message of the agent, as it is told. `input_reader`: which of the received
    samples waits in the input buffer itself, at its end, and has no slot elsewhere; `input_free` bytes are in front of
    it, which is as much as any other message takes. `line_input`: the largest message that comes on a reliable stream
    or as an answer, which nobody may lose. `send_buffer`: of a serial line that sends by itself; it holds the longest
    frame, each of its bytes stuffed, or one message of each best-effort writer. `keeps_output`: messages of the
    reliable stream are not among them: the line takes them from where they are.
    """

    mtu: int
    best_effort_size: int
    reliable_slots: int
    reliable_slot_size: int
    input_size: int
    best_effort_slots: int = 0
    best_effort_places: int = 1
    creation_size: int = 0
    creation_fragments: bool = False
    fragments: bool = False
    reliable_input_slots: int = 0
    line_input: int = WRITE_SIDE_INPUT
    send_buffer: int = 0
    keeps_output: bool = False
    arrives_in_fragments: bool = False
    input_reader: int | None = None
    input_free: int = 0
    input_slot: int = 0

    @property
    def best_effort_shown(self) -> str:
        """What reports say of the best-effort stream: its bytes, with a queue as `3 x 24`."""
        times = f"{self.best_effort_places} x " if self.best_effort_slots else ""
        return f"{times}{self.best_effort_size}"

    @property
    def input_buffer(self) -> int:
        """Bytes of the buffer that messages are received in."""
        return max(self.input_size, self.input_free + self.input_slot)

    @property
    def ram(self) -> int:
        """Bytes of all buffers together."""
        reliable = self.reliable_slots * self.reliable_slot_size
        inputs = max(0, self.reliable_input_slots - 1) * self.input_size + self.input_buffer
        best_effort = self.best_effort_size * self.best_effort_places
        return best_effort + reliable + inputs + self.creation_size


def plan_streams(
    application: Application,
    transport: str,
    written: Iterable[Written],
    create: int,
    diagnostics: Diagnostics,
    reliable_input: bool = False,
    received: Iterable[Received] = (),
    create_text: int = 0,
    lends_input: bool = False,
    keeps_output: bool = False,
    reliable_output: bool = False,
    best_effort_output: bool = False,
) -> StreamSizes:
    """Size the streams; a message that cannot fit its stream is an error with the number that would do.

    `transport` is the selected one. `create` is the size of the largest CREATE (client/plan/creation.py), 0 where the
    client creates nothing (entities: preconfigured), and `create_text` how much of it a serial line never
    stuffs. With `creation: reliable` it has its own storage, and the reliable stream is there for it. A
    reliable message above the MTU goes in fragments, as a CREATE does there; a best-effort one cannot.
    `reliable_input`: the agent's reliable stream is selected; a reliable DATA above the input buffer comes in parts,
    since the client announces the size of that buffer to the agent. `lends_input`: a best-effort sample may wait in the
    input buffer. `keeps_output`: the line can take a message from its stream. `reliable_output`, `best_effort_output`:
    this stream is selected, even where nothing is written to it. `pools.slot_size` makes each buffer at least so large.
    """
    messages, samples = tuple(written), tuple(received)
    ceiling = application.transport.mtu or default_mtu(transport, create)
    for message in messages:
        _check_fits(message, ceiling, transport, application, diagnostics)
    for sample in samples:
        _check_received(sample, ceiling, transport, application, diagnostics)
    _check_create(create, ceiling, transport, application, diagnostics)
    requested = application.pools.get("slot_size", 0)
    least = min(requested, ceiling)
    best_effort = max((_datagram(m) for m in messages if m.best_effort), default=0)
    reliable = max((_datagram(m) for m in messages if m.reliable), default=0)
    reliable = max(reliable, requested) if reliable else 0
    slots = application.pools.get("history", default_history(reliable)) if reliable else 0
    fragments = reliable > ceiling
    if fragments and slots == 1 and application.on_full == "drop_oldest":
        diagnostics.error(
            "'on_full: drop_oldest' with fragments needs a history of 2: a message that is on its way is not dropped",
            application.spans.get("pools.history"),
            "Set `pools: {history: 2}`",
            id="MG-7023",
        )
    creation = create if application.creation and application.creation.name == "reliable" else 0
    request_in_fragments = creation > ceiling
    if not creation:
        best_effort = max(best_effort, create)
    if (creation or reliable_output) and not reliable:
        slots, reliable = 1, WRITE_DATA_OVERHEAD
    best_effort = max(best_effort, least, WRITE_DATA_OVERHEAD) if best_effort or best_effort_output else 0
    queued = output_slots(application, sum(m.best_effort for m in messages), best_effort, diagnostics)
    input_size = max(
        min(WRITE_SIDE_INPUT, ceiling),
        least,
        *(sample.largest_message(ceiling, FRAGMENTS_PER_SAMPLE[transport]) for sample in samples),
    )
    must = [
        sample.largest_message(ceiling, FRAGMENTS_PER_SAMPLE[transport])
        for sample in samples
        if sample.reliable
    ]
    line = _Line(
        _send_frames(application, (m for m in messages if not m.reliable), ceiling, (create, create_text)),
        _send_frames(application, messages, ceiling, (create, create_text)),
    )
    # What is dropped on its way would be broken off: where more is written than the line carries, nothing arrived.
    kept = (
        keeps_output
        and not fragments
        and application.on_full != "drop_oldest"
        and not application.transport.seal
    )
    kept = kept and line.saves(application.transport.send_buffer)
    in_input_buffer = (
        _lent(samples, max(WRITE_SIDE_INPUT, least), ceiling, FRAGMENTS_PER_SAMPLE[transport])
        if lends_input
        else None
    )
    return StreamSizes(
        mtu=ceiling if fragments or request_in_fragments else max(best_effort, reliable, create),
        best_effort_size=best_effort,
        best_effort_slots=queued,
        best_effort_places=queued + (1 if create and not creation else 0) if queued else 1,
        reliable_slots=slots,
        reliable_slot_size=_align4(reliable + FRAGMENT_HEADER) if fragments else reliable,
        input_size=input_size,
        creation_size=creation + (FRAGMENT_HEADER if request_in_fragments else 0),
        creation_fragments=request_in_fragments,
        fragments=fragments,
        reliable_input_slots=input_slots(application, reliable_input, diagnostics),
        arrives_in_fragments=any(sample.streamed or sample.whole > input_size for sample in samples),
        input_reader=in_input_buffer[0] if in_input_buffer else None,
        input_free=in_input_buffer[1] if in_input_buffer else 0,
        input_slot=slot_of(samples[in_input_buffer[0]].max_size) if in_input_buffer else 0,
        line_input=carried(max((WRITE_SIDE_INPUT, *must)), application),
        send_buffer=_send_buffer(application, messages, line.kept if kept else line.copied, diagnostics)
        if transport in _LINES
        else 0,
        keeps_output=kept,
    )


@dataclass(frozen=True)
class _Line:
    """Bytes that the output of a serial line needs at least, without and with the messages of the reliable stream."""

    kept: int
    copied: int

    def saves(self, requested: int | None) -> bool:
        """Whether it is worth its code to leave them out, and nobody asked for room for them."""
        return self.copied - self.kept >= LEAST_KEPT and (requested is None or requested < self.copied)


def _send_frames(
    application: Application, messages: Iterable[Written], ceiling: int, create: tuple[int, int]
) -> int:
    """Return the bytes of the longest frame that is copied, each stuffed, and the one that is never used."""
    session = _SESSION_MESSAGE_HARD if application.hard_liveliness_ms else _SESSION_MESSAGE
    largest = max((session, *(min(_datagram(message), ceiling) for message in messages)))
    frames = [
        longest_frame(carried(size, application)) - (0 if application.transport.seal else text)
        for size, text in ((largest, 0), create)
    ]
    return max(frames) + 1


def _send_buffer(
    application: Application, messages: tuple[Written, ...], least: int, diagnostics: Diagnostics
) -> int:
    """Return the bytes that a serial line needs for its output, of which one is never used."""
    at_once = sum(usual_frame(carried(_datagram(m), application)) for m in messages if m.best_effort)
    requested = application.transport.send_buffer
    if requested is not None and requested < least:
        diagnostics.error(
            f"'transport.send_buffer' is {requested} and the longest frame on the line may take {least - 1} bytes",
            application.spans.get("transport.send_buffer"),
            f"Set send_buffer: {_align4(least)} or more, or lower transport.mtu or the limits of the largest message",
            id="MG-7024",
        )
    return _align4(requested or max(least, at_once + 1))


def usual_frame(size: int) -> int:
    """Return the bytes that a message takes on a serial line, four times as many stuffed as of random ones."""
    return _FRAME_FLAG + _FRAME_REST + size + size // _STUFFED_SHARE


def longest_frame(size: int) -> int:
    """Return the bytes that a message takes on a serial line if all but the flag is stuffed."""
    return _FRAME_FLAG + 2 * (size + _FRAME_REST)


def _lent(samples: tuple[Received, ...], least: int, ceiling: int, fragments: int) -> tuple[int, int] | None:
    """Return which sample waits in the input buffer, and the bytes in front of it; None: that would save too little.

    It is the largest of those that are best effort and wait alone: a message that does not fit in front of it takes its
    place, which such a sample must allow. So every other message has to fit.
    """
    alone = [i for i, s in enumerate(samples) if s.alone and s.best_effort and not s.reliable]
    if not alone:
        return None
    chosen = max(alone, key=lambda i: samples[i].whole)
    free = max(
        [least, *(s.largest_message(ceiling, fragments) for i, s in enumerate(samples) if i != chosen)]
    )
    return (chosen, free) if samples[chosen].whole >= free + LEAST_LENT else None


def slot_of(size: int) -> int:
    """Return the bytes of a slot: a body, padded as some writers do."""
    return _align4(max(size, 1))


def _check_create(
    create: int, ceiling: int, transport: str, application: Application, diagnostics: Diagnostics
) -> None:
    reliable = application.creation is not None and application.creation.name == "reliable"
    if create > (most_in_fragments(ceiling) if reliable else ceiling):
        larger = create <= largest_mtu(transport)
        way = f"Set transport.mtu: {create}" if larger else "Write `creation: reliable`: it goes in fragments"
        diagnostics.error(
            f"the longest CREATE message takes {create} bytes and {mtu_is(application, transport)} {ceiling}",
            application.transport.mtu_span or application.transport.span,
            f"{way}, or shorten the longest topic name",
            id="MG-7026",
        )


def _larger_mtu(size: int, transport: str) -> str:
    """Return the advice to take a larger MTU, where the transport has one."""
    return f"Set transport.mtu: {size}, or lower" if size <= largest_mtu(transport) else "Lower"


def _check_fits(
    message: Written, ceiling: int, transport: str, application: Application, diagnostics: Diagnostics
) -> None:
    size = _datagram(message)
    span = message.span or application.transport.mtu_span or application.transport.span
    if message.max_encoded_size > LARGEST_BODY:
        diagnostics.too_large(
            f"{message.label} takes up to {message.max_encoded_size} bytes, but a message holds at most {LARGEST_BODY}",
            span,
            f"Lower its limits{message.hint}",
            id="MG-7027",
        )
    elif message.best_effort and size > ceiling:
        declare = "declare its publisher under `nodes:` as reliable"
        reliable = declare if message.reliable else "make it reliable"
        diagnostics.too_large(
            f"{message.label} takes up to {size} bytes in its stream and {mtu_is(application, transport)} {ceiling}",
            span,
            f"{_larger_mtu(size, transport)} its limits{message.hint}, or {reliable}: reliable messages"
            " are sent in fragments",
            id="MG-7028",
            mtu=size,
        )


def _check_received(
    sample: Received, ceiling: int, transport: str, application: Application, diagnostics: Diagnostics
) -> None:
    size = sample.whole
    span = sample.span or application.transport.mtu_span or application.transport.span
    if sample.max_size > LARGEST_BODY:
        diagnostics.too_large(
            f"{sample.label} takes up to {sample.max_size} bytes, but a message holds at most {LARGEST_BODY}",
            span or application.spans.get("limits"),  # what a component opens by itself has no place
            "Lower its limits",
            id="MG-7029",
        )
    elif sample.best_effort and size > ceiling:
        declare = "declare its subscription under `nodes:` as reliable"
        reliable = declare if sample.reliable else "make it reliable"
        diagnostics.too_large(
            f"{sample.label} takes up to {size} bytes when it arrives and {mtu_is(application, transport)} {ceiling}",
            span,
            f"{_larger_mtu(size, transport)} its limits, or {reliable}: reliable messages come in fragments",
            id="MG-7030",
            mtu=size,
        )


def _datagram(message: Written) -> int:
    return _align4(WRITE_DATA_OVERHEAD + message.max_encoded_size)


def _align4(size: int) -> int:
    return (size + 3) & ~3
