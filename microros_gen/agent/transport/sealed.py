# SPDX-License-Identifier: Apache-2.0
"""A transport whose messages are sealed; others are refused and counted.

An address of it is that of the transport within and the client key, which the handshake has proved. So no client can
send in the session of another one, whatever address it pretends to have.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable, Mapping

from microros_gen.agent.fairness import Account
from microros_gen.agent.log import EventLog
from microros_gen.agent.seal.handshakes import INDICES, Handshakes
from microros_gen.agent.seal.layout import Kind
from microros_gen.agent.seal.session import RecordError
from microros_gen.agent.transport.base import Origin, Receive, SealedAddress, Transport
from microros_gen.agent.transport.observed import ObservedTransport
from microros_gen.agent.transport.outbox import Refusal, SealedRecord, SealedSample, is_sample
from microros_gen.agent.wire.constants import STREAM_NONE, Status, SubmessageId
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import Header, header_size, split
from microros_gen.agent.wire.session_messages import CreateClient, StatusAgent
from microros_gen.agent.wire.submessages import decode, encode


class SealedTransport(ObservedTransport):
    """A transport whose clients share a key with the agent."""

    def __init__(
        self,
        inner: Transport,
        keys: Mapping[int, bytes],
        log: EventLog,
        clock: Callable[[], float] = time.monotonic,
        strangers: Account | None = None,
        indices: range = INDICES,
    ) -> None:
        """Wrap `inner`; `keys` has the pre-shared key of each client key. `clock`: seconds, monotonic.

        `indices`: those that its sessions may have.

        The account `strangers`, which is the agent's, is charged for handshakes and for what is refused.
        """
        super().__init__(inner)
        self.forgeable = False  # who sends a record has received the second message of a handshake
        self._handshakes = Handshakes(keys, indices)
        self._log = log
        self._clock = clock
        self._strangers = strangers or Account()
        self.name_of = self._name_of
        self.origin = self._origin
        self.claim = self._claim
        self.release = self._release
        self.proved_key = _proved_key

    def _observe(self, data: bytes, address: Hashable, inbound: bool) -> None:
        """See ObservedTransport: `pump` and `send` do all."""

    def use_keys(self, keys: Mapping[int, bytes]) -> None:
        """Replace the pre-shared keys; sessions of a client whose key is another one now, or is missing, end."""
        self._handshakes.use(keys)

    def pump(self, receive: Receive) -> None:
        """See Transport."""

        def opened(data: bytes, address: Hashable, _transport: Transport) -> None:
            began = self._clock()
            try:
                message, client_key = self._open(data, address)
            except RecordError as error:
                self._count(str(error), address)
                message, client_key = b"", 0
            if message:
                receive(message, SealedAddress(address, client_key), self)
            else:
                now = self._clock()
                self._strangers.bill(now - began, now)

        self._inner.pump(opened)

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""
        within, client_key = _parts(address)
        record = self._handshakes.seal(data, client_key, within)
        if record is not None:
            self._inner.send(SealedSample(record) if is_sample(data) else SealedRecord(record), within)

    def _name_of(self, address: Hashable) -> str:
        return self._inner.name_of(_within(address))

    def _origin(self, address: Hashable) -> Origin:
        return self._inner.origin(_within(address))

    def _claim(self, address: Hashable, account: Account) -> None:
        self._inner.claim(_within(address), account)

    def _release(self, address: Hashable, moved: bool = False) -> None:
        self._inner.release(_within(address), moved)

    def _open(self, data: bytes, address: Hashable) -> tuple[bytes, int]:
        """Return the message in a record, empty for a handshake, and its client key. Raises RecordError."""
        kind = data[0] if data else 0
        if kind == Kind.FIRST:
            answer, fault = self._handshakes.answer(data, address, self._clock())
            self._inner.send(Refusal(answer) if fault else answer, address)
            if fault:
                raise RecordError(fault)
            return b"", 0
        if kind != Kind.RECORD:
            self._deny(data, address)
            raise RecordError("seal_missing")
        message, session = self._handshakes.open(data, address)
        if not _is_from(message, session.client_key):
            denial = _denial(message)
            record = denial and session.seal(denial)
            if record:
                self._inner.send(Refusal(record), address)
            raise RecordError("seal_other_client")
        return message, session.client_key

    def _deny(self, data: bytes, address: Hashable) -> None:
        """Tell a client without a seal that it may not connect."""
        answer = _denial(data)
        if answer:
            self._inner.send(Refusal(answer), address)

    def _count(self, kind: str, address: Hashable) -> None:
        self._log.count(kind, "a message from {peer} was refused", peer=self._inner.name_of(address))


def _proved_key(address: Hashable) -> bytes:
    return _parts(address).client_key.to_bytes(4, "big")


def _parts(address: Hashable) -> SealedAddress:
    assert isinstance(address, SealedAddress)
    return address


def _within(address: Hashable) -> Hashable:
    return _parts(address).within


def _is_from(message: bytes, client_key: int) -> bool:
    """Return whether the client keys in a message are `client_key`."""
    own = client_key.to_bytes(4, "big")
    if len(message) >= 8 and message[0] < 0x80 and message[4:8] != own:
        return False
    created = _created(message)
    return created is None or created.key == own


def _created(message: bytes) -> CreateClient | None:
    """Return the CREATE_CLIENT with which a message begins; None: it begins with none."""
    try:
        start = header_size(message)
        if message[start : start + 1] != bytes([SubmessageId.CREATE_CLIENT]):
            return None
        for identifier, flags, at, end in split(message, start)[:1]:
            found = decode(identifier, flags, message, at, end)
            return found if isinstance(found, CreateClient) else None
    except MalformedError:
        return None
    return None


def _denial(message: bytes) -> bytes:
    """Return the answer DENIED to a CREATE_CLIENT, shorter than that; empty for other messages."""
    created = _created(message)
    if created is None:
        return b""
    header = Header.decode(message)
    return Header(header.session, STREAM_NONE, 0, header.key).encode() + encode(StatusAgent(Status.DENIED))
