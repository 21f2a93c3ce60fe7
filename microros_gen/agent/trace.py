# SPDX-License-Identifier: Apache-2.0
"""What messages say, for -v (one line each) and -vv (decoded, and in hexadecimal)."""

from __future__ import annotations

from collections.abc import Hashable

from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.transport.base import Receive, Transport
from microros_gen.agent.wire.constants import SubmessageId
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import Header, header_size, split
from microros_gen.agent.wire.submessages import decode


class TracedTransport:
    """A transport that writes every message to the log."""

    def __init__(self, inner: Transport, log: EventLog) -> None:
        self._inner = inner
        self._log = log
        self.label = inner.label
        self.fileno = inner.fileno
        self.name_of = inner.name_of
        self.tick = inner.tick
        self.close = inner.close

    @property
    def ready(self) -> bool:
        """See Transport."""
        return self._inner.ready

    def pump(self, receive: Receive) -> None:
        """See Transport."""

        def traced(data: bytes, address: Hashable, _transport: Transport) -> None:
            self._write("from", data, address)
            receive(data, address, self)

        self._inner.pump(traced)

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""
        self._write("to", data, address)
        self._inner.send(data, address)

    def _write(self, way: str, data: bytes, address: Hashable) -> None:
        level = Level.TRACE if self._log.shows(Level.TRACE) else Level.DEBUG
        lines = dump(data) if level is Level.TRACE else [summary(data)]
        for line in lines:
            peer = self._inner.name_of(address)
            self._log.emit(level, "message", "{way} {peer} {line}", way=way, peer=peer, line=line)


def summary(data: bytes) -> str:
    """Return header and names of the submessages of a message in one line; never raises."""
    try:
        head = Header.decode(data)
        names = [_name(span[0]) for span in split(data, header_size(data))]
    except MalformedError as error:
        return f"malformed: {error}"
    place = f"session {head.session:#04x} stream {head.stream:#04x} sequence {head.sequence}"
    return f"{place}: {', '.join(names) or 'nothing'}"


def dump(data: bytes) -> list[str]:
    """Return the summary, every submessage decoded, then all bytes, 16 a line; never raises."""
    lines = [summary(data)]
    try:
        spans = split(data, header_size(data))
    except MalformedError:
        spans = []
    for identifier, flags, start, end in spans:
        try:
            lines.append(f"  {decode(identifier, flags, data, start, end)!r}")
        except MalformedError as error:
            lines.append(f"  {_name(identifier)} malformed: {error}")
    return lines + [f"  {at:04x}  {data[at : at + 16].hex(' ')}" for at in range(0, len(data), 16)]


def _name(identifier: int) -> str:
    known = identifier <= SubmessageId.TIMESTAMP_REPLY
    return SubmessageId(identifier).name if known else f"{identifier:#04x}"
