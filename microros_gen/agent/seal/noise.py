# SPDX-License-Identifier: Apache-2.0
"""The responder of Noise_NNpsk0_25519_ChaChaPoly_SHA256, with empty payloads.

Section numbers are those of The Noise Protocol Framework, revision 34. The primitives are those of the package
`cryptography`; the names of this module need it.
"""

from __future__ import annotations

import hmac
from collections.abc import Callable
from hashlib import sha256

from cryptography.exceptions import InvalidTag
from cryptography.hazmat.primitives.asymmetric.x25519 import X25519PrivateKey, X25519PublicKey
from cryptography.hazmat.primitives.ciphers.aead import ChaCha20Poly1305

from microros_gen.records import dataclass

NAME = b"Noise_NNpsk0_25519_ChaChaPoly_SHA256"
KEY_BYTES = 32
TAG_BYTES = 16
MESSAGE_BYTES = KEY_BYTES + TAG_BYTES
"""Size of both messages of the handshake: an ephemeral public key, and the tag of an empty payload."""
_FIRST_NONCE = bytes(12)


class HandshakeError(ValueError):
    """A first message that was not made with the key."""


@dataclass(frozen=True)
class SessionKeys:
    """The keys of a session, 32 bytes each: of records from the client, and of those to it."""

    receiving: bytes
    sending: bytes


def respond(
    psk: bytes, prologue: bytes, message: bytes, verified: Callable[[], object]
) -> tuple[bytes, SessionKeys]:
    """Return the second message of the handshake that `message` (48 bytes) begins, and the session's keys.

    `verified` is called when the message is known to be made with the key, before the expensive part.
    Raises HandshakeError if it was made with another key or prologue, or has a point of small order.
    """
    state = _State(prologue)
    state.mix_psk(psk)
    remote = message[:KEY_BYTES]
    state.mix_ephemeral(remote)
    try:
        state.open(message[KEY_BYTES:])
    except InvalidTag:
        raise HandshakeError("another key") from None
    verified()
    secret = X25519PrivateKey.generate()
    local = secret.public_key().public_bytes_raw()
    state.mix_ephemeral(local)
    try:
        state.mix_key(secret.exchange(X25519PublicKey.from_public_bytes(remote)))
    except ValueError:  # RFC 7748, 6.1: all zeros
        raise HandshakeError("a point of small order") from None
    return local + state.seal(), state.split()


class _State:
    """The symmetric state of 5.2, and the key of the next payload, of which each is used once."""

    def __init__(self, prologue: bytes) -> None:
        self._hash = self._chain = sha256(NAME).digest()
        self._key = b""
        self._mix_hash(prologue)

    def mix_psk(self, psk: bytes) -> None:
        """Mix in the pre-shared key (MixKeyAndHash)."""
        self._chain, mixed, self._key = _derive(self._chain, psk, 3)
        self._mix_hash(mixed)

    def mix_ephemeral(self, point: bytes) -> None:
        """Mix an ephemeral public key into both, as with a pre-shared key (9.2)."""
        self._mix_hash(point)
        self.mix_key(point)

    def mix_key(self, data: bytes) -> None:
        """Mix data into the key (MixKey)."""
        self._chain, self._key = _derive(self._chain, data, 2)

    def open(self, tag: bytes) -> None:
        """Verify the tag of an empty payload (DecryptAndHash). Raises InvalidTag."""
        ChaCha20Poly1305(self._key).decrypt(_FIRST_NONCE, tag, self._hash)
        self._mix_hash(tag)

    def seal(self) -> bytes:
        """Return the tag of an empty payload (EncryptAndHash)."""
        tag = ChaCha20Poly1305(self._key).encrypt(_FIRST_NONCE, b"", self._hash)
        self._mix_hash(tag)
        return tag

    def split(self) -> SessionKeys:
        """Return the keys of the session, as the responder has them."""
        return SessionKeys(*_derive(self._chain, b"", 2))

    def _mix_hash(self, data: bytes) -> None:
        self._hash = sha256(self._hash + data).digest()


def _derive(chain: bytes, data: bytes, outputs: int) -> list[bytes]:
    """Return outputs of HKDF (4.3)."""
    root = hmac.digest(chain, data, "sha256")
    found: list[bytes] = []
    for number in range(1, outputs + 1):
        found.append(hmac.digest(root, (found[-1] if found else b"") + bytes([number]), "sha256"))
    return found
