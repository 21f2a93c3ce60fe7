# SPDX-License-Identifier: Apache-2.0
"""A transport around another one that sees all of its messages."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Hashable

from microros_gen.agent.transport.base import Receive, Transport


class ObservedTransport(ABC):
    """Passes everything on to the transport within."""

    def __init__(self, inner: Transport) -> None:
        self._inner = inner
        self.label = inner.label
        self.forgeable = inner.forgeable
        self.fileno = inner.fileno
        self.name_of = inner.name_of
        self.origin = inner.origin
        self.tick = inner.tick
        self.flush = inner.flush
        self.claim = inner.claim
        self.release = inner.release
        self.close = inner.close
        self.proved_key = inner.proved_key

    @abstractmethod
    def _observe(self, data: bytes, address: Hashable, inbound: bool) -> None:
        """See a message before it is received from (`inbound`) or sent to the client at an address."""

    def show_sent(self, data: bytes, address: Hashable) -> None:
        """See a message that is sent to an address in another way."""
        self._observe(data, address, inbound=False)
        if isinstance(self._inner, ObservedTransport):
            self._inner.show_sent(data, address)

    @property
    def ready(self) -> bool:
        """See Transport."""
        return self._inner.ready

    def pump(self, receive: Receive) -> None:
        """See Transport."""

        def observed(data: bytes, address: Hashable, _transport: Transport) -> None:
            self._observe(data, address, inbound=True)
            receive(data, address, self)

        self._inner.pump(observed)

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""
        self._observe(data, address, inbound=False)
        self._inner.send(data, address)
