# SPDX-License-Identifier: Apache-2.0
"""What a client in session asks for, beside its samples: one method a submessage."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from types import MappingProxyType

from microros_gen.agent.clients import Client
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.objects import Outcome
from microros_gen.agent.representation import Endpoint
from microros_gen.agent.wire.constants import (
    STREAM_BEST_EFFORT,
    STREAM_NONE,
    STREAM_RELIABLE,
    ObjectKind,
    Status,
    is_reliable,
)
from microros_gen.agent.wire.data_messages import ReadData
from microros_gen.agent.wire.entity_messages import (
    Acknack,
    Create,
    Delete,
    Fragment,
    Heartbeat,
    Reset,
    StatusReply,
)
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.session_messages import (
    AgentActivity,
    AgentConfig,
    GetInfo,
    Info,
    Timestamp,
    TimestampReply,
)
from microros_gen.agent.wire.submessages import Submessage

Handler = Callable[[Client, Submessage, float], None]
READABLE = (ObjectKind.DATAREADER, ObjectKind.REQUESTER, ObjectKind.REPLIER)


class Operations:
    """Dispatches by submessage; answers go out at once, acknowledgements with the agent's next flush."""

    def __init__(self, log: EventLog, limits: Limits) -> None:
        self._log = log
        self._limits = limits
        handlers: dict[type, Handler] = {
            Create: self._create,
            Delete: self._delete,
            GetInfo: self._get_info,
            ReadData: self._read_data,
            Acknack: self._acknack,
            Heartbeat: self._heartbeat,
            Reset: self._reset,
            Fragment: self._fragment,
            Timestamp: self._timestamp,
        }
        self._handlers: Mapping[type, Handler] = MappingProxyType(handlers)

    def run(self, client: Client, submessage: Submessage, now: float) -> None:
        """Carry out one submessage of `client`; MalformedError when it makes no sense from a client."""
        handler = self._handlers.get(type(submessage))
        if handler is None:
            raise MalformedError("unexpected_submessage", f"{submessage.ID.name} from a client in session")
        handler(client, submessage, now)

    def _create(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, Create)
        outcome = client.objects.create(submessage)
        self._answer(client, submessage.request, submessage.object, outcome.status, now)
        tell_outcome(self._log, client, submessage.object & 0xFFF0 | submessage.kind, outcome)

    def _delete(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, Delete)
        status = client.objects.delete(submessage.object)
        self._answer(client, submessage.request, submessage.object, status, now)
        self._log.emit(
            Level.DEBUG,
            "deleted",
            "client {client}: delete {object}: {status}",
            client=client.name,
            object=f"{submessage.object:#06x}",
            status=status.name,
        )

    def _read_data(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, ReadData)
        known = any(e.id == submessage.object and e.kind in READABLE for e in client.objects)
        status = Status.DENIED if known else Status.UNKNOWN_REFERENCE
        self._answer(client, submessage.request, submessage.object, status, now)

    def _get_info(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, GetInfo)
        client.send(client.session.unnumbered(agent_info(submessage, in_session=True)))

    def _acknack(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, Acknack)
        for message in client.session.acknowledged(submessage, now):
            client.send(message)

    def _heartbeat(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, Heartbeat)
        start = len(client.session.link.header(STREAM_NONE, 0))
        for message in client.session.announced(submessage):
            client.ready.append((message, start, submessage.stream, False))
        client.unacknowledged.add(submessage.stream)

    def _reset(self, client: Client, submessage: Submessage, now: float) -> None:
        client.session.reset()
        client.unacknowledged.clear()

    def _fragment(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, Fragment)
        whole = client.session.fragment(client.stream, submessage)
        if whole is not None:
            client.ready.appendleft((whole, 0, client.stream, True))

    def _timestamp(self, client: Client, submessage: Submessage, now: float) -> None:
        assert isinstance(submessage, Timestamp)
        moment = divmod(time.time_ns(), 1_000_000_000)
        client.send(client.session.unnumbered(TimestampReply(moment, moment, submessage.transmit)))

    def _answer(self, client: Client, request: int, object_id: int, status: Status, now: float) -> None:
        stream = STREAM_RELIABLE if is_reliable(client.stream) else STREAM_BEST_EFFORT
        messages = client.session.send(stream, StatusReply(request, object_id, status), now)
        if messages is None:
            self._log.count(
                "output_full", "client {client} does not acknowledge: answers are dropped", client=client.name
            )
        for message in messages or ():
            client.send(message)


def agent_info(question: GetInfo, in_session: bool) -> Info:
    """Return the answer to a GET_INFO; whatever object and mask it names, the agent tells about itself."""
    return Info(question.request, question.object, Status.OK, int(in_session), AgentConfig(), AgentActivity())


def tell_outcome(log: EventLog, client: Client, object_id: int, outcome: Outcome) -> None:
    """Tell of an object that was made, or why it was not."""
    kind = ObjectKind(object_id & 0x0F).name.lower()
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
        about = outcome.entity.description
        log.emit(
            Level.INFO,
            "created",
            "client {client}: {kind} {label}" + (" ({qos})" if isinstance(about, Endpoint) else ""),
            client=client.name,
            kind={"participant": "node", "datawriter": "publisher"}.get(kind, kind),
            label=outcome.entity.label,
            qos=str(about.qos) if isinstance(about, Endpoint) else "",
        )
