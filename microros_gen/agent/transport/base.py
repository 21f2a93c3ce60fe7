# SPDX-License-Identifier: Apache-2.0
"""What the agent needs of a transport. A stream transport cuts its stream into messages itself."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Protocol

from microros_gen.agent.fairness import Account

Receive = Callable[[bytes, Hashable, "Transport"], None]
"""Takes one message, the address that it came from, and the transport."""


class Transport(Protocol):
    """One way to clients. Addresses are its own, hashable, and differ from those of other transports."""

    @property
    def label(self) -> str:
        """Kind and own address for the log and the ready line, as `udp4 127.0.0.1:8888`."""

    @property
    def ready(self) -> bool:
        """Whether messages are taken: not before a serial device is there."""

    @property
    def forgeable(self) -> bool:
        """Whether a message may come from elsewhere than its address says."""

    def fileno(self) -> int:
        """Return the descriptor that is readable while `pump` has something to do.

        It is the same as long as the transport lives: one with several descriptors returns an epoll descriptor.
        """

    def pump(self, receive: Receive) -> None:
        """Write what waits, hand on what has arrived; not more than a batch of it, without waiting. Never raises."""

    def tick(self, now: float) -> None:
        """Do what time brings (`now`: seconds, monotonic); called some ten times a second. Never raises."""

    def claim(self, address: Hashable, account: Account) -> None:
        """Note that a client is in session at an address: what comes from there is read in its turn. Never raises."""

    def release(self, address: Hashable, moved: bool = False) -> None:
        """Note that none is there any more; `moved`: it sends from elsewhere now, and what is unread is too old.

        Never raises.
        """

    def send(self, data: bytes, address: Hashable) -> None:
        """Send one message without waiting; one that cannot go out is lost. Never raises."""

    def name_of(self, address: Hashable) -> str:
        """Return an address as the log shows it."""

    def close(self) -> None:
        """Give every descriptor back."""
