# SPDX-License-Identifier: Apache-2.0
"""Decides by the policy which client may open a session, and whether one that is in session may stay."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Hashable
from pathlib import Path

from microros_gen.agent.checks import RefusedError
from microros_gen.agent.clients import Client
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.policy.access import Access
from microros_gen.agent.policy.model import ClientRule, Policy
from microros_gen.agent.policy.patterns import matches
from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.transport.base import Transport

_WITHIN_PART = re.compile(r"(?<=[^/])\*\*+|\*\*+(?=[^/])")
"""`**` beside other characters of a part, for which `Path.glob` of Python 3.12 raises ValueError."""
Refused = Callable[[str, Transport, Hashable, str], object]
"""Function that is told about a refused client: its key as in the log, where it is, and why."""


class Gatekeeper:
    """The current policy; None: every client may connect, and use everything."""

    def __init__(self, log: EventLog, policy: Policy | None = None) -> None:
        self._log = log
        self.policy = policy
        self.refused: Refused = _unwatched
        """Called for each refused session."""

    def decide(
        self, key: bytes, transport: Transport, address: Hashable, client: Client | None
    ) -> Access | None:
        """Return what the client with `key` at an address may use; report and count it if it is refused (None).

        `client` is in session with that key, if any. While it is not silent, no session at a place of another rule
        ends it: a key is no secret.
        """
        access, reason = self._judge(key, transport, address)
        if client is not None and access is not None and self._keeps(client, transport, address):
            access, reason = None, f"it is in session at {client.place}, where another rule is for it"
            self._log.counters["takeover_denied"] += 1
        elif access is None:
            self._log.counters["client_denied"] += 1
        if access is None:
            name = key.hex().upper()
            text = "client {client} at {peer} was refused: {reason}"
            peer = transport.name_of(address)
            self._log.emit(Level.WARNING, "client_denied", text, client=name, peer=peer, reason=reason)
            self.refused(name, transport, address, reason)
        return access

    def may_move(self, key: bytes, access: Access, transport: Transport, address: Hashable) -> bool:
        """Return whether a client may continue its session at another address: the same rule is for it there."""
        if self.policy is None:
            return True
        found = self._find(self.policy, key, transport, address)
        return found is not None and not found.refuse and found == access.rule

    def _keeps(self, client: Client, transport: Transport, address: Hashable) -> bool:
        if client.asleep or client.address == address:
            return False
        return not self.may_move(client.session.link.key, client.access, transport, address)

    def review(self, client: Client) -> tuple[Access, str]:
        """Return what a client in session may use after a reload; a text is the reason why it may not stay."""
        found, reason = self._judge(client.session.link.key, client.transport, client.address)
        if found is None:
            return client.access, reason
        if _domain(found) != _domain(client.access):
            return found, "the policy has another domain for it"
        try:
            client.objects.check(found)
        except (RefusedError, BridgeError) as error:
            return found, str(error)
        return found, ""

    def _judge(self, key: bytes, transport: Transport, address: Hashable) -> tuple[Access | None, str]:
        if self.policy is None:
            return Access(), ""
        rule = self._find(self.policy, key, transport, address)
        if rule is None:
            return None, "no rule of the policy is for it"
        return (None, f"the rule {rule.label} refuses it") if rule.refuse else (Access(rule), "")

    def _find(self, policy: Policy, key: bytes, transport: Transport, address: Hashable) -> ClientRule | None:
        number, origin = int.from_bytes(key, "big"), transport.origin(address)
        for rule in policy.rules:
            if rule.keys and not any(number in keys for keys in rule.keys):
                continue
            if not rule.addresses and not rule.devices:
                return rule
            if isinstance(origin, str):
                if any(is_device(pattern, origin) for pattern in rule.devices):
                    return rule
            elif any(origin.version == n.version and origin in n for n in rule.addresses):
                return rule
        return None


def _domain(access: Access) -> int | None:
    return access.rule.domain if access.rule is not None else None


def is_device(pattern: str, device: str) -> bool:
    """Return whether a pattern fits the path of a device, or that of a link in the file system which leads to it."""
    if matches(pattern, device):
        return True
    if not pattern.startswith("/") or not pattern.strip("/"):
        return False
    listed = _WITHIN_PART.sub("*", pattern.lstrip("/"))
    wanted = os.path.realpath(device)
    return wanted.startswith("/dev/") and any(
        matches(pattern, link) and os.path.realpath(link) == wanted
        for link in map(str, Path("/").glob(listed))
    )


def _unwatched(_key: str, _transport: Transport, _address: Hashable, _reason: str) -> None:
    """Do nothing."""
