# SPDX-License-Identifier: Apache-2.0
"""Sealed transports: the file of keys, and what is needed to use it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.util import find_spec

from microros_gen.agent.configuration.model import SocketChoice, TransportChoice
from microros_gen.agent.fairness import Account
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.seal.keys import read_keys
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.sockets import PROTOCOLS
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.diagnostics import Diagnostics


def read_psk_file(options: AgentOptions, diagnostics: Diagnostics) -> Mapping[int, bytes] | None:
    """Return the pre-shared key of each client key, None if the options name no file; faults go to `diagnostics`."""
    path = options.psk_file
    if path is None:
        return None
    span = options.places.get(path)
    for name in [_name(choice) for choice in options.transports if not _is_datagram(choice)]:
        message = f"messages over {name} are not sealed, and --psk-file refuses clients without a seal"
        diagnostics.error(message, span, "Serve it by another agent, or use udp4 or udp6", id="MG-3269")
    if options.discovery is not None:
        message = "answers to searches are not sealed, and --psk-file refuses clients without a seal"
        diagnostics.error(message, span, "Remove --discovery: give the devices the address", id="MG-3273")
    if find_spec("cryptography") is None:
        message = "--psk-file needs the Python package cryptography"
        diagnostics.error(message, span, "pip install 'microros-gen[seal]'", id="MG-3271")
    return read_keys(path, diagnostics, span)


def sealed(
    transports: Sequence[Transport], keys: Mapping[int, bytes] | None, log: EventLog, strangers: Account
) -> list[Transport]:
    """Return the transports, sealed where there are keys."""
    if keys is None:
        return list(transports)
    from microros_gen.agent.transport.sealed import SealedTransport  # needs cryptography

    text = "sealed: keys of {clients} clients; others are refused"
    log.emit(Level.INFO, "sealed", text, clients=len(keys))
    return [SealedTransport(transport, keys, log, strangers=strangers) for transport in transports]


def _is_datagram(choice: TransportChoice) -> bool:
    return isinstance(choice, SocketChoice) and not PROTOCOLS[choice.kind].stream


def _name(choice: TransportChoice) -> str:
    return choice.kind if isinstance(choice, SocketChoice) else "a line or a bus"
