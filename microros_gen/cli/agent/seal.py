# SPDX-License-Identifier: Apache-2.0
"""Sealed transports: the file of keys, and what is needed to use it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from importlib.util import find_spec
from typing import TYPE_CHECKING

from microros_gen.agent.configuration.model import CanChoice
from microros_gen.agent.core import Agent
from microros_gen.agent.fairness import Account
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.seal.keys import read_keys
from microros_gen.agent.transport.base import Transport
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.diagnostics import Diagnostics

if TYPE_CHECKING:
    from microros_gen.agent.transport.sealed import SealedTransport


def read_psk_file(options: AgentOptions, diagnostics: Diagnostics) -> Mapping[int, bytes] | None:
    """Return the pre-shared key of each client key, None if the options name no file; faults go to `diagnostics`."""
    path = options.psk_file
    if path is None:
        return None
    span = options.places.get(path)
    if any(isinstance(choice, CanChoice) for choice in options.transports):
        message = "messages over CAN FD are not sealed, and --psk-file refuses clients without a seal"
        hint = "Serve the bus by another agent, or use udp4, udp6, tcp4, tcp6 or serial"
        diagnostics.error(message, span, hint, id="MG-3269")
    if options.discovery is not None:
        message = "answers to searches are not sealed, and --psk-file refuses clients without a seal"
        diagnostics.error(message, span, "Remove --discovery: give the devices the address", id="MG-3273")
    if find_spec("cryptography") is None:
        message = "--psk-file needs the Python package cryptography"
        diagnostics.error(message, span, "pip install 'microros-gen[seal]'", id="MG-3271")
    return read_keys(path, diagnostics, span)


class PskFile:
    """The file of keys of a running agent: read at the start, and again on SIGHUP."""

    def __init__(self, options: AgentOptions, keys: Mapping[int, bytes] | None, log: EventLog) -> None:
        """Begin with `keys`, those of the file; None: the options name no file."""
        self._options = options
        self._keys = keys
        self._log = log
        if keys is not None:
            self._report(len(keys))

    def reloading(self, use: Callable[[Mapping[int, bytes]], object]) -> Callable[[], None] | None:
        """Return the function that reads the file again and gives it to `use`; None without a file."""
        return partial(self._reload, use) if self._keys is not None else None

    def _reload(self, use: Callable[[Mapping[int, bytes]], object]) -> None:
        diagnostics = Diagnostics()
        keys = read_psk_file(self._options, diagnostics)
        for diagnostic in diagnostics:
            self._log.emit(Level.WARNING, "seal_fault", "{reason}", reason=diagnostic.headline())
        if keys is None or diagnostics.has_errors():
            text = "the new file of keys has faults; the keys before it stay in force"
            self._log.emit(Level.WARNING, "seal_kept", text)
            return
        use(keys)
        self._report(len(keys))

    def _report(self, clients: int) -> None:
        self._log.emit(
            Level.INFO, "sealed", "sealed: keys of {clients} clients; others are refused", clients=clients
        )


class Seals:
    """The sealed transports of an agent, or of one of its workers."""

    def __init__(self, keys: Mapping[int, bytes] | None, log: EventLog) -> None:
        """Begin with `keys`; None: nothing is sealed."""
        self._keys = keys
        self._log = log
        self._transports: list[SealedTransport] = []

    def sealed(
        self, transports: Sequence[Transport], strangers: Account, indices: range | None = None
    ) -> list[Transport]:
        """Return the transports, sealed where there are keys; the account `strangers` pays for what is refused.

        `indices`: those that sessions may have; None: all.
        """
        if self._keys is None:
            return list(transports)
        from microros_gen.agent.seal.handshakes import INDICES
        from microros_gen.agent.transport.sealed import SealedTransport  # needs cryptography

        allowed = INDICES if indices is None else indices
        self._transports = [
            SealedTransport(transport, self._keys, self._log, strangers=strangers, indices=allowed)
            for transport in transports
        ]
        return list(self._transports)

    def use(self, agent: Agent, keys: Mapping[int, bytes]) -> None:
        """Replace the keys; sessions of a client whose key is another one now, or is missing, end."""
        before, self._keys = self._keys or {}, keys
        ended = {client for client, key in before.items() if keys.get(client) != key}
        # They are told so while that can still be sealed.
        agent.end_sessions(ended, "disconnected: its key was removed or changed")
        for transport in self._transports:
            transport.use_keys(keys)
