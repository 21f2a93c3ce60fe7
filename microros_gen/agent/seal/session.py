# SPDX-License-Identifier: Apache-2.0
"""The records of one session of a sealed link, and its replay window."""

from __future__ import annotations

import struct

from cryptography.exceptions import InvalidTag
from cryptography.hazmat.primitives.ciphers.aead import ChaCha20Poly1305

from microros_gen.agent.seal.layout import FIRST, RECORD, VERSION, Kind
from microros_gen.agent.seal.noise import MESSAGE_BYTES, TAG_BYTES, SessionKeys

FIRST_BYTES = FIRST.size + MESSAGE_BYTES
OVERHEAD_BYTES = RECORD.size + TAG_BYTES
"""Bytes of a record around its message."""
LAST_RECORD = 0xFFFF_0000
"""Number of records in one direction after which a session ends."""
WINDOW = 64
"""Counters below the highest one that are still accepted."""


class RecordError(ValueError):
    """A record that is not accepted; its text is the kind for the log's counters."""


class Session:
    """The records of one client in both directions."""

    def __init__(self, keys: SessionKeys, client_key: int, own: int, peer: int) -> None:
        """Use the keys of a handshake; `own` and `peer` are the indices in front of records from and to the client."""
        self._incoming = ChaCha20Poly1305(keys.receiving)
        self._outgoing = ChaCha20Poly1305(keys.sending)
        self.client_key = client_key
        self.own = own
        self._peer = peer
        self._sent = 0
        self._newest = -1
        self._seen = 0  # bit i: the counter `_newest - i` arrived

    def open(self, data: bytes) -> bytes:
        """Return the message of a record with the index `own`. Raises RecordError."""
        counter = RECORD.unpack_from(data)[4]
        age = self._newest - counter
        if counter > LAST_RECORD:
            raise RecordError("seal_worn_out")
        if age >= WINDOW or (age >= 0 and self._seen >> age & 1):
            raise RecordError("seal_replayed")
        try:
            message = self._incoming.decrypt(_nonce(counter), data[RECORD.size :], None)
        except InvalidTag:
            raise RecordError("seal_forged") from None
        if age < 0:
            self._seen = (self._seen << -age if -age < WINDOW else 0) & (1 << WINDOW) - 1 | 1
            self._newest = counter
        else:
            self._seen |= 1 << age
        return message

    def seal(self, message: bytes) -> bytes | None:
        """Return the record of a message; None: the session has ended, and its client begins the next one."""
        counter = self._sent
        if counter > LAST_RECORD:
            return None
        self._sent += 1
        head = RECORD.pack(Kind.RECORD, VERSION, 0, self._peer, counter)
        return head + self._outgoing.encrypt(_nonce(counter), message, None)


def _nonce(counter: int) -> bytes:
    return struct.pack("<IQ", 0, counter)
