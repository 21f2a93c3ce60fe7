# SPDX-License-Identifier: Apache-2.0
"""The sessions of sealed links: handshakes, the sessions that they lead to, and the current one of each client."""

from __future__ import annotations

import secrets
from collections.abc import Hashable, Mapping

from microros_gen.agent.rates import Rate
from microros_gen.agent.seal.layout import FIRST, LABEL, RECORD, REFUSAL, VERSION, Kind, Reason
from microros_gen.agent.seal.noise import HandshakeError, respond
from microros_gen.agent.seal.session import FIRST_BYTES, RecordError, Session

HANDSHAKES_PER_SECOND = 100
"""Handshakes of all clients that are answered, on average: each takes the agent some 0.3 ms."""
UNCONFIRMED = 4
"""Sessions of a client without a record yet: anyone who sees a first message can send it again."""
INDICES = range(1 << 32)
"""Indices that sessions may have; a worker uses those for which `layout.worker_of` returns it."""
Peer = Hashable


class Handshakes:
    """The sessions of all clients at one transport.

    A session replaces an earlier one of its client with its first record, which proves that the client has the keys: a
    first message that is sent again ends no session.
    """

    def __init__(self, keys: Mapping[int, bytes], indices: range = INDICES) -> None:
        """Use the pre-shared key (32 bytes) of each client key, and an index of `indices` for each session."""
        self._keys = keys
        self._indices = indices
        self._rate = Rate(HANDSHAKES_PER_SECOND)
        self._current: dict[int, tuple[Session, Peer]] = {}
        self._unconfirmed: dict[int, list[tuple[Session, Peer]]] = {}
        self._answers: dict[int, tuple[bytes, bytes]] = {}
        """First and second message of each unconfirmed session, by its index."""
        self._by_index: dict[int, tuple[Session, Peer]] = {}

    def answer(self, data: bytes, peer: Peer, now: float) -> tuple[bytes, str]:
        """Return the answer to a first message, and the kind of fault (empty: none) for the log's counters.

        The answer is never longer than `data`. `now`: seconds of a monotonic clock. Raises RecordError for a message
        that gets no answer.
        """
        if len(data) != FIRST_BYTES:
            raise RecordError("seal_malformed")
        _, version, reserved, index, client_key = FIRST.unpack_from(data)
        if version != VERSION or reserved:
            return _refusal(index, Reason.OTHER_VERSION), "seal_other_version"
        psk = self._keys.get(client_key)
        if psk is None:
            return _refusal(index, Reason.UNKNOWN_KEY), "seal_unknown_key"

        def pay() -> None:  # only by the owner of the key, or who repeats what it sent
            if not self._rate.take(now):
                raise RecordError("seal_too_many")

        for waiting, at in self._unconfirmed.get(client_key, ()):
            first, answer = self._answers[waiting.own]
            if at == peer and first == data:  # repeated: the client uses the answer that arrives first
                return answer, ""
        try:
            second, keys = respond(psk, LABEL + data[: FIRST.size], data[FIRST.size :], pay)
        except HandshakeError:
            return _refusal(index, Reason.OTHER_KEY), "seal_other_key"
        own = self._new_index()
        session = Session(keys, client_key, own, index)
        answer = FIRST.pack(Kind.SECOND, VERSION, 0, own, index) + second
        self._answers[own] = (data, answer)
        self._add(session, peer)
        return answer, ""

    def open(self, data: bytes, peer: Peer) -> tuple[bytes, Session]:
        """Return the message of a record from `peer`, and its session. Raises RecordError."""
        if len(data) < RECORD.size:
            raise RecordError("seal_malformed")
        _, version, reserved, index, _ = RECORD.unpack_from(data)
        if version != VERSION or reserved:
            raise RecordError("seal_malformed")
        session, at = self._by_index.get(index, (None, None))
        if session is None or at != peer:
            raise RecordError("seal_no_session")
        message = session.open(data)
        current = self._current.get(session.client_key)
        if current is None or current[0] is not session:
            self._confirm(session, peer)
        return message, session

    def seal(self, message: bytes, client_key: int, peer: Peer) -> bytes | None:
        """Return the record of a message to a client; None: it has no session there."""
        session, at = self._current.get(client_key, (None, None))
        return None if session is None or at != peer else session.seal(message)

    def use(self, keys: Mapping[int, bytes]) -> None:
        """Replace the pre-shared keys; sessions of a client whose key is another one now, or is missing, end."""
        before, self._keys = self._keys, keys
        for client_key in [key for key in before if keys.get(key) != before[key]]:
            current = self._current.pop(client_key, None)
            for session, _ in (*self._unconfirmed.pop(client_key, ()), *((current,) if current else ())):
                del self._by_index[session.own]
                self._answers.pop(session.own, None)

    def _new_index(self) -> int:
        while True:
            index = secrets.choice(self._indices)
            if index not in self._by_index:
                return index

    def _add(self, session: Session, peer: Peer) -> None:
        waiting = self._unconfirmed.setdefault(session.client_key, [])
        waiting.append((session, peer))
        self._by_index[session.own] = (session, peer)
        if len(waiting) > UNCONFIRMED:
            oldest = waiting.pop(0)[0].own
            del self._by_index[oldest], self._answers[oldest]

    def _confirm(self, session: Session, peer: Peer) -> None:
        """Make a session the only one of its client."""
        current = self._current.get(session.client_key)
        unconfirmed = self._unconfirmed.pop(session.client_key, ())
        for old, _ in unconfirmed:
            del self._answers[old.own]
        for old, _ in (*unconfirmed, *((current,) if current else ())):
            if old is not session:
                del self._by_index[old.own]
        self._current[session.client_key] = (session, peer)


def _refusal(index: int, reason: Reason) -> bytes:
    return REFUSAL.pack(Kind.REFUSAL, VERSION, reason, 0, index)
