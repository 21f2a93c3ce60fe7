# SPDX-License-Identifier: Apache-2.0
"""Execution of one READ_DATA: passes data from ROS 2 for a reader, replier or requester to the client.

Nothing is queued here. Samples that the delivery control (DDS-XRCE 1.0, 7.7.14 and table 9) or the window of the
reliable stream does not permit yet stay in DDS, whose QoS limits how many are kept.

In FORMAT_DATA each sample is a separate message, though several in one would cost less: the rmw of micro-ROS takes
one message at a time and has room for four samples by default, so it would lose samples of a reliable stream. A client
that accepts several samples in a message requests a sequence format.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from microros_gen.agent.entities import Entity, Readable
from microros_gen.agent.log import EventLog
from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.services import swapped
from microros_gen.agent.wire.cdr import Writer
from microros_gen.agent.wire.constants import (
    FLAG_LITTLE,
    STREAM_BEST_EFFORT,
    STREAM_RELIABLE,
    DataFormat,
    ObjectKind,
    SubmessageId,
    is_reliable,
)
from microros_gen.agent.wire.data_messages import DeliveryControl, ReadData
from microros_gen.agent.wire.samples import (
    SEQUENCES,
    VIEW_NEW,
    Sample,
    SampleInfo,
    overhead,
    packs,
    write_samples,
)

if TYPE_CHECKING:
    from microros_gen.agent.clients import Client

MOST_SAVED: Final = 256
"""Maximum number of samples kept for a client that timed out: taking them from ROS 2 takes some milliseconds."""
TURN: Final = 64
"""Messages that one reading sends before the next one's turn."""
RETRY_S: Final = 0.1
"""Seconds until the next attempt after ROS 2 failed to return a sample."""
UNLIMITED: Final = 0xFFFF
"""MAX_SAMPLES_UNLIMITED."""
ONCE = DeliveryControl(max_samples=1)
"""Default without delivery control: one sample, as soon as it is available."""
NEVER: Final = float("inf")
DATA: Final = int(SubmessageId.DATA)


class Reading:
    """One READ_DATA of a client, and its progress."""

    def __init__(self, client: Client, entity: Entity, wanted: ReadData, now: float, log: EventLog) -> None:
        control = wanted.delivery or ONCE
        self.client = client
        self.account = client.account
        """The account that is charged."""
        self.entity = entity
        self.source: Readable | None = None
        """Its source of data; None while the client is not in the ROS graph."""
        self._from_ros: Callable[[], Any] = _nothing
        self.stream = _stream(client, wanted.stream)
        self.over = False
        """Whether it is complete."""
        self.waiting = False
        """Whether it waits for space on its stream."""
        self.scheduled = False
        """Whether a time is scheduled at which it continues."""
        self._pending: tuple[bytes, int] | None = None
        """A DATA for which there was no space, and its number of samples."""
        self._raw: tuple[bytes, ...] = ()
        """The samples of the last DATA."""
        self._keeps = entity.keeps and is_reliable(self.stream)
        self._log = log
        self._calls = entity.kind != ObjectKind.DATAREADER
        self._format = wanted.format
        self._head = wanted.request.to_bytes(2, "big") + wanted.object.to_bytes(2, "big")
        self._left: float = NEVER if control.max_samples == UNLIMITED else control.max_samples
        self._until = now + control.max_elapsed_time if control.max_elapsed_time else NEVER
        self._rate = control.max_bytes_per_second
        self._pace_s = control.min_pace_period / 1000
        self._limited = bool(control.min_pace_period or self._rate)
        self._next_at = now
        self._apart_s = entity.separation_s
        self._received_at = -NEVER
        self._plain = not (self._calls or self._format or self._apart_s)
        """Whether each sample is a DATA in FORMAT_DATA, and none is skipped."""
        self._lead, self._lead_of = b"", (-1, -1)
        """What precedes a sample in its DATA; flag and size for which it was made."""

    def attach(self, source: Readable | None) -> None:
        """Read from `source` from now on."""
        self.source = source
        self._from_ros = _nothing if source is None else source.take

    def has_room(self) -> bool:
        """Return whether its stream accepts a message now."""
        return self.client.session.output(self.stream).has_room()

    def deliver(self, now: float) -> float | None:
        """Deliver data from ROS 2, as far as the client's delivery control and stream permit.

        Return the time of the next call; None if it depends on ROS 2 or an acknowledgement, or if the reading is
        complete (`over`).
        """
        client = self.client
        output = client.session.output(self.stream)
        send, address = client.transport.send, client.address
        for _ in range(TURN):
            if self._left <= 0 or now >= self._until:
                self.over = True
                return None
            if now < self._next_at:
                return self._next_at
            if not output.has_room():
                self._wait()
                return None
            try:
                submessage, count = self._pending or self._next(now)
            except BridgeError as error:
                self._log.count("take", "client {client}: {reason}", client=client.name, reason=str(error))
                return now + RETRY_S
            if not submessage:
                return None
            if not count:
                continue
            kept = (self.entity.id, self._raw) if self._keeps else None
            messages = output.push(submessage, now, kept)
            if messages is None:
                if output.may_take(
                    len(submessage)
                ):  # the pending output of all clients takes too much memory now
                    self._pending = submessage, count
                    self._wait()
                    return None
                self._too_large(len(submessage))
                continue
            self._pending = None
            client.sent += len(messages)
            for message in messages:
                client.sent_bytes += len(message)
                send(message, address)
            self.entity.delivered += count
            self._left -= count
            if self._limited:
                self._spend(len(submessage), now)
        return now

    def give_back(self) -> None:
        """Keep the samples of a DATA for which there was no space; this reading ends, another one may follow."""
        if self._pending is not None and self._keeps:
            self.entity.keep(self._raw, self.client.shares)
        self._pending = None

    def save(self) -> int:
        """Keep the samples that ROS 2 has for a client that timed out; return the number that did not fit."""
        if not self._keeps or self.source is None:
            return 0
        taken: list[bytes] = []
        while len(taken) < MOST_SAVED and (sample := self._from_ros()) is not None:
            taken.append(sample)
        return self.entity.keep(taken, self.client.shares, after=True)

    def _put_back(self, sample: bytes) -> None:
        self.client.shares.history.add(len(sample))
        self.entity.kept.append(sample)

    def _next(self, now: float) -> tuple[bytes, int]:
        """Return the next DATA (empty: ROS 2 has no data) and its number of samples (0: one was skipped)."""
        if self._calls:
            return self._next_call()
        taken = self.entity.next_kept(self.client.shares) if self.entity.kept else self._from_ros()
        if taken is None:
            return b"", 0
        if self._plain:
            self._raw = (taken,)
            flag, size = taken[1] & FLAG_LITTLE, len(taken)
            if self._lead_of != (flag, size):
                self._lead, self._lead_of = self._lead_for(flag, size), (flag, size)
            return self._lead + taken[4:], 1
        if self._apart_s:
            if now - self._received_at < self._apart_s:
                return taken, 0
            self._received_at = now
        if self._format:
            return self._gather(taken, now)
        self._raw = (taken,)
        return self._data(b"", taken), 1

    def _take(self) -> bytes | None:
        """Return the next sample of a reader."""
        if self.entity.kept:
            return self.entity.next_kept(self.client.shares)
        return self._from_ros()  # type: ignore[no-any-return]

    def _next_call(self) -> tuple[bytes, int]:
        """Return the DATA of the next request or reply, preceded by its number or identity."""
        taken = self._from_ros()
        if taken is None:
            return b"", 0
        key, data = taken
        if self.entity.kind == ObjectKind.REPLIER:
            self.client.calls.add_request(self.entity, key)
            return self._data(key if data[1] & FLAG_LITTLE else swapped(key), data), 1
        ids = self.client.calls.answered(self.entity, key)
        return (self._data(ids, data), 1) if ids else (data, 0)

    def _data(self, prefix: bytes, data: bytes) -> bytes:
        """Return a DATA with a sample of ROS 2, whose first four bytes are the encapsulation header."""
        return self._lead_for(data[1] & FLAG_LITTLE, len(prefix) + len(data)) + prefix + data[4:]

    def _lead_for(self, little: int, size: int) -> bytes:
        """Return the header and the ids of a DATA with `size` bytes: the ids take the place of the sample's header."""
        if size > 0xFFFF:
            size = 0  # length 0 extends to the end: as clients send it, and in fragments anyway
        return bytes((DATA, little, size & 0xFF, size >> 8)) + self._head

    def _gather(self, first: bytes, now: float) -> tuple[bytes, int]:
        """Return a DATA in one of the other formats, as full as the client's message size allows."""
        little = first[1] & FLAG_LITTLE
        samples, raw = [self._sample(first, 0, now)], [first]
        fixed, each = overhead(self._format)
        room = self.client.session.link.room() - 8 - fixed - each - (len(first) - 4)
        while self._format in SEQUENCES and len(samples) < self._left:
            taken = self._take()
            if taken is None:
                break
            sample = self._sample(taken, len(samples), now)
            room -= each + len(sample.body)
            if room < 0 or taken[1] & FLAG_LITTLE != little or not packs(samples[0].info, sample.info):
                self._put_back(taken)
                break
            samples.append(sample)
            raw.append(taken)
        self._raw = tuple(raw)
        writer = Writer(bool(little))
        write_samples(writer, self._format, samples)
        body = writer.content()
        size = 4 + len(body) if len(body) <= 0xFFFB else 0
        head = bytes((DATA, little | self._format, size & 0xFF, size >> 8))
        return head + self._head + body, len(samples)

    def _sample(self, data: bytes, ahead: int, now: float) -> Sample:
        if self._format == DataFormat.DATA_SEQ:
            return Sample(data[4:])
        number = self.entity.delivered + ahead
        offset = round((now - self.client.opened) * 1000) & 0xFFFFFFFF
        return Sample(data[4:], SampleInfo(0 if number else VIEW_NEW, number & 0xFFFFFFFF, offset))

    def _spend(self, size: int, now: float) -> None:
        paid = max(now, self._next_at) + size / self._rate if self._rate else now
        self._next_at = max(paid, now + self._pace_s)

    def _wait(self) -> None:
        if not self.waiting:
            self.waiting = True
            self.client.waiting.append(self)

    def _too_large(self, size: int) -> None:
        self._log.count(
            "sample_too_large",
            "client {client}: a sample of {label} has {size} bytes and was dropped:"
            " on a best-effort stream it has to fit the client's message size ({mtu})",
            client=self.client.name,
            label=self.entity.label,
            size=size,
            mtu=self.client.session.link.mtu,
        )


def _nothing() -> None:
    return None


def _stream(client: Client, preferred: int) -> int:
    """Return the stream for samples: that of the request for STREAMID_NONE, and a built-in one beyond the limit."""
    reliable = is_reliable(preferred or client.stream)
    builtin = STREAM_RELIABLE if reliable else STREAM_BEST_EFFORT
    return preferred if preferred and client.session.may_send_on(preferred) else builtin
