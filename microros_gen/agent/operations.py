# SPDX-License-Identifier: Apache-2.0
"""The requests of clients in session, one method for each submessage."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from microros_gen.agent.clients import Client
from microros_gen.agent.cutting import SAMPLES, Cutting, TurnOverError
from microros_gen.agent.deliveries import Deliveries
from microros_gen.agent.entities import Entity, Outcome
from microros_gen.agent.history import HistoryFullError
from microros_gen.agent.log import EventLog, Json, Level
from microros_gen.agent.representation import Endpoint
from microros_gen.agent.ros.bridge import BridgeError, BusyError
from microros_gen.agent.services import ENCAPSULATION
from microros_gen.agent.steps import Steps
from microros_gen.agent.turns import Turns
from microros_gen.agent.wire.cdr import Reader
from microros_gen.agent.wire.constants import (
    DATA_FORMAT_MASK,
    FLAG_LITTLE,
    INFO_ACTIVITY,
    INFO_CONFIG,
    STREAM_BEST_EFFORT,
    STREAM_NONE,
    STREAM_RELIABLE,
    DataFormat,
    ObjectKind,
    Status,
    is_reliable,
)
from microros_gen.agent.wire.data_messages import DATA_PREFIX, ReadData
from microros_gen.agent.wire.entity_messages import (
    Acknack,
    Create,
    Delete,
    Heartbeat,
    Representation,
    Reset,
    StatusReply,
)
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.samples import LIFE_CYCLE, Sample
from microros_gen.agent.wire.session_messages import (
    AgentActivity,
    AgentConfig,
    GetInfo,
    Info,
    ReaderActivity,
    Timestamp,
    TimestampReply,
    WriterActivity,
)
from microros_gen.agent.wire.submessages import Submessage, encode

Handler = Callable[[Client, Submessage, float], "Steps[None] | None"]
"""A function for a submessage; it may return steps that are still to be done."""
MOST_REPORTS, MOST_CREDIT = 2, 262_144
"""How often a client whose address may be forged gets the configuration of an object, and how many bytes at most."""
CALLS = (ObjectKind.REQUESTER, ObjectKind.REPLIER)
READABLE = (ObjectKind.DATAREADER, *CALLS)
NAMES = {
    "participant": "node",
    "datawriter": "publisher",
    "datareader": "subscription",
    "requester": "service client",
    "replier": "service",
}
"""Names for people of objects that have a ROS 2 entity."""


class Operations:
    """Dispatcher by submessage. Answers are sent at once, after the due acknowledgements."""

    def __init__(self, log: EventLog, deliveries: Deliveries, turns: Turns) -> None:
        self._turns = turns
        self._log = log
        self._deliveries = deliveries
        handlers: dict[type, Handler] = {
            Create: self._create,
            Delete: self._delete,
            GetInfo: self._get_info,
            ReadData: self._read_data,
            Acknack: self._acknack,
            Heartbeat: self._heartbeat,
            Reset: self._reset,
            Timestamp: self._timestamp,
        }
        self._handlers: Mapping[type, Handler] = MappingProxyType(handlers)

    def run(self, client: Client, submessage: Submessage, now: float) -> Steps[None] | None:
        """Process one submessage of `client`, or return the steps to do so.

        Raises MalformedError if it is invalid from a client.
        """
        handler = self._handlers.get(type(submessage))
        if handler is None:
            raise MalformedError("unexpected_submessage", f"{submessage.ID.name} from a client in session")
        return handler(client, submessage, now)

    def _create(self, client: Client, submessage: Submessage, now: float) -> Steps[None]:
        assert isinstance(submessage, Create)
        client.credit = min(MOST_CREDIT, client.credit + MOST_REPORTS * len(submessage.representation.body))
        stream = client.stream
        outcome = yield from client.objects.creating(submessage)
        client.stream = stream
        self._deliveries.refresh(client, now)
        self._answer(client, submessage.request, submessage.object, outcome.status, now)
        report_outcome(self._log, client, submessage.object & 0xFFF0 | submessage.kind, outcome)

    def _delete(self, client: Client, submessage: Submessage, now: float) -> Steps[None]:
        assert isinstance(submessage, Delete)
        stream = client.stream
        status = yield from client.objects.deleting(submessage.object)
        client.stream = stream
        self._deliveries.refresh(client, now)
        self._answer(client, submessage.request, submessage.object, status, now)
        self._log.emit(
            Level.DEBUG,
            "deleted",
            "client {client}: delete {object}: {status}",
            client=client.name,
            object=f"{submessage.object:#06x}",
            status=status.name,
        )

    def refuse(self, client: Client, data: bytes, at: int, status: Status, now: float) -> None:
        """Answer a refused request, whose ids begin at `data[at]`, with `status` (DDS-XRCE 1.0, table 2)."""
        request, object_id = data[at] << 8 | data[at + 1], data[at + 2] << 8 | data[at + 3]
        self._answer(client, request, object_id, status, now)

    def write(self, client: Client, data: bytes, at: int, end: int, flags: int, done: int) -> int:
        """Process a WRITE_DATA other than a plain sample of a data writer; return the number of samples sent to ROS 2.

        `done` of its samples were sent before. Raises BusyError if the rest may be sent later.
        """
        if end - at < DATA_PREFIX:
            raise MalformedError("truncated", f"WRITE_DATA of {end - at} bytes")
        form = flags & DATA_FORMAT_MASK
        entity = client.objects.find(data[at + 2] << 8 | data[at + 3])
        try:
            if entity is not None and entity.writer is not None:
                samples = self._samples(client, data, at, end, flags, done)
                return self._write_samples(client, entity, samples, bool(flags & FLAG_LITTLE), done)
            if entity is not None and entity.source is not None and entity.kind in CALLS:
                if form:
                    raise MalformedError("data_format", f"format {form:#04x} for requests and replies")
                payload = bytes(data[at + DATA_PREFIX : end])
                return client.calls.write(entity, bytes(data[at : at + DATA_PREFIX]), payload, flags)
        except BusyError:
            raise
        except MalformedError:
            client.samples = None
            raise
        except BridgeError as error:
            client.samples = None
            self.not_written(client, error)
            return 0
        self._log.count(
            "unknown_writer",
            "client {client}: a sample for data writer {object}, which it has not created",
            client=client.name,
            object=data[at + 2 : at + 4].hex(),
        )
        return 0

    def not_written(self, client: Client, error: BridgeError) -> None:
        """Count a sample that ROS 2 refused."""
        client.account.refused = True
        kind = "history_full" if isinstance(error, HistoryFullError) else "publish"
        self._log.count(kind, "client {client}: {reason}", client=client.name, reason=str(error))

    def waits(self, client: Client, kind: str, error: BusyError) -> None:
        """Count that a reliable stream of `client` was stopped for now."""
        text = "client {client}: {reason}; this request and the following ones on its stream wait, unacknowledged"
        self._log.count(kind, text, client=client.name, reason=str(error))

    def acknowledged(self, client: Client, stream: int, first: int, missing: int, now: float) -> None:
        """Process an ACKNACK: send the missing messages again, then the waiting ones."""
        for message in client.session.acknowledged(stream, first, missing, now):
            client.send(message)
        if client.waiting:
            self._deliveries.note_room(client)

    def _write_samples(
        self, client: Client, writer: Entity, samples: Sequence[Sample], little: bool, done: int
    ) -> int:
        written = 0
        for place, sample in enumerate(samples[done:], done):
            if sample.info.state & LIFE_CYCLE:
                self._log.count(
                    "life_cycle",
                    "client {client}: disposes or unregisters an instance of {label}:"
                    " ROS 2 topics have no instances, it was dropped",
                    client=client.name,
                    label=writer.label,
                )
                continue
            try:
                writer.publish(ENCAPSULATION[little] + sample.body)
            except BusyError as error:
                raise BusyError(str(error), place) from error
            written += 1
            if place % SAMPLES == SAMPLES - 1 and self._turns.over:
                raise TurnOverError(place + 1)
        client.samples = None
        return written

    def _samples(
        self, client: Client, data: bytes, at: int, end: int, flags: int, done: int
    ) -> Sequence[Sample]:
        """Return the samples of a WRITE_DATA, stored until all are processed; TurnOverError until all are decoded."""
        kept = client.samples
        if kept is None or not kept.is_of(data, at):
            reader = Reader(data, at + DATA_PREFIX, end, bool(flags & FLAG_LITTLE))
            kept = client.samples = Cutting(data, at, reader, flags & DATA_FORMAT_MASK)
        return kept.go_on(lambda: self._turns.over, done)

    def _read_data(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, ReadData)
        entity = client.objects.find(submessage.object)
        status, reason = _check_reading(entity, submessage)
        if entity is None or status is not Status.OK:
            self._answer(client, submessage.request, submessage.object, status, now)
            self._log.emit(
                Level.WARNING,
                "read_refused",
                "client {client}: reading from {object} refused ({status}): {reason}",
                client=client.name,
                object=f"{submessage.object:#06x}",
                status=status.name,
                reason=reason,
            )
            return
        self._deliveries.start(client, entity, submessage, now)

    def _get_info(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, GetInfo)
        if submessage.object & 0x0F in (ObjectKind.AGENT, ObjectKind.CLIENT):
            client.send(client.session.unnumbered(agent_info(submessage, in_session=True)))
            return
        info = object_info(client, submessage)
        if info.config is not None and not self._may_report(client, info.config):
            info = replace(info, config=None)
        entity = client.objects.find(submessage.object)
        little = entity is None or entity.representation is None or entity.representation.little
        if len(encode(info, little)) > client.session.link.room() and not is_reliable(client.stream):
            info = replace(info, config=None)  # it does not fit, and there is no stream for fragments
        if client.stream == STREAM_NONE:
            client.send(client.session.unnumbered(info, little))
        else:
            self._send(client, info, now, little)

    def _may_report(self, client: Client, config: object) -> bool:
        """Return whether a client gets a configuration of this size.

        Over UDP the address may be forged, so answers are at most twice as long as the requests in total."""
        if not client.transport.forgeable or not isinstance(config, Representation):
            return True
        size = len(config.body)
        if size > client.credit:
            client.account.refused = True
            text = "client {client} at {peer} no longer gets the configuration of an object: it requests it too often"
            self._log.count("info_withheld", text, client=client.name, peer=client.place)
            return False
        client.credit -= size
        return True

    def _acknack(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, Acknack)
        self.acknowledged(client, submessage.stream, submessage.first, submessage.missing, now)

    def _heartbeat(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, Heartbeat)
        start = len(client.session.link.header(STREAM_NONE, 0))
        for message in client.session.announced(submessage):
            client.ready.append((message, start, submessage.stream, False, 0))
        client.unacknowledged.add(submessage.stream)

    def _reset(self, client: Client, submessage: Submessage, now: float) -> None:
        client.session.reset()
        client.unacknowledged.clear()
        self._deliveries.room(client, now)

    def _timestamp(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, Timestamp)
        here = time.time_ns()
        received = divmod(here - round((now - client.last_received) * 1e9), 1_000_000_000)
        sent = divmod(time.time_ns(), 1_000_000_000)
        client.send(client.session.unnumbered(TimestampReply(sent, received, submessage.transmit)))

    def _answer(self, client: Client, request: int, object_id: int, status: Status, now: float) -> None:
        self._send(client, StatusReply(request, object_id, status), now)

    def _send(self, client: Client, answer: Submessage, now: float, little: bool = True) -> None:
        """Send the answer on the built-in stream of the same kind as that of the request."""
        if isinstance(answer, StatusReply) and answer.status >= Status.DDS_ERROR:
            client.account.refused = True
        stream = STREAM_RELIABLE if is_reliable(client.stream) else STREAM_BEST_EFFORT
        messages = client.session.output(stream).push(encode(answer, little), now)
        if messages is None:
            self._log.count(
                "output_full", "client {client} does not acknowledge: answers are dropped", client=client.name
            )
        client.acknowledge()  # some clients need that slot for their next request before they look further
        for message in messages or ():
            client.send(message)


def _check_reading(entity: Entity | None, wanted: ReadData) -> tuple[Status, str]:
    if entity is None or entity.kind not in READABLE:
        return Status.UNKNOWN_REFERENCE, "the client has no such reader, requester or replier"
    if wanted.content_filter:
        return Status.INCOMPATIBLE, f"ROS 2 cannot filter by content: '{wanted.content_filter}'"
    if wanted.format not in list(DataFormat):
        return Status.INVALID_DATA, f"unknown data format {wanted.format:#04x}"
    if wanted.format and entity.kind in CALLS:
        return Status.INVALID_DATA, "requests and replies come in FORMAT_DATA only"
    return Status.OK, ""


def agent_info(question: GetInfo, in_session: bool) -> Info:
    """Return the answer to a GET_INFO: a description of the agent, whatever the object and mask."""
    return Info(question.request, question.object, Status.OK, int(in_session), AgentConfig(), AgentActivity())


def object_info(client: Client, question: GetInfo) -> Info:
    """Return the answer to a GET_INFO on an object (7.8.3.3): what the mask requests and the object has."""
    entity = client.objects.find(question.object)
    if entity is None:
        return Info(question.request, question.object, Status.UNKNOWN_REFERENCE, 1)
    config = entity.representation if question.mask & INFO_CONFIG else None
    activity: WriterActivity | ReaderActivity | None = None
    if question.mask & INFO_ACTIVITY and entity.kind == ObjectKind.DATAWRITER:
        activity = WriterActivity(entity.written, _signed(client.session.last_received()))
    elif question.mask & INFO_ACTIVITY and entity.kind == ObjectKind.DATAREADER:
        reading = client.readings.get(entity.id)
        stream = reading.stream if reading else STREAM_RELIABLE
        activity = ReaderActivity(_signed(client.session.last_acknowledged(stream)))
    return Info(question.request, question.object, Status.OK, 1, config, activity)


def _signed(number: int) -> int:
    return number - 0x10000 if number >= 0x8000 else number


def report_outcome(log: EventLog, client: Client, object_id: int, outcome: Outcome) -> None:
    """Report that an object was created, or why it was not."""
    kind = ObjectKind(object_id & 0x0F).name.lower()
    if outcome.status is Status.DENIED:
        client.denials += 1
        log.counters["denied"] += 1
    if outcome.status >= Status.DDS_ERROR:
        log.emit(
            Level.WARNING,
            "create_refused",
            "client {client}: {kind} {object} refused ({status}): {reason}",
            client=client.name,
            kind=kind,
            object=f"{object_id:#06x}",
            status=outcome.status.name,
            reason=outcome.reason,
        )
    elif outcome.entity and outcome.entity.label and outcome.status == Status.OK:
        about, node = outcome.entity.description, outcome.entity.node
        more: dict[str, Json] = {"qos": str(about.qos) if isinstance(about, Endpoint) else ""}
        if node is not None:
            more["domain"] = node.domain
        log.emit(
            Level.INFO,
            "created",
            "client {client}: {kind} {label}"
            + (" ({qos})" if isinstance(about, Endpoint) else "")
            + (" in ROS domain {domain}" if node is not None else ""),
            client=client.name,
            kind=NAMES.get(kind, kind),
            label=outcome.entity.label,
            **more,
        )
