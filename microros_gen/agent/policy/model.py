# SPDX-License-Identifier: Apache-2.0
"""The contents of a policy file. Rules are tried in their order, and the first one that fits decides."""

from __future__ import annotations

from dataclasses import field, replace
from ipaddress import IPv4Network, IPv6Network
from typing import Any

from microros_gen.agent.limits import Limits
from microros_gen.agent.policy.patterns import matches
from microros_gen.agent.representation import Durability
from microros_gen.diagnostics import Span
from microros_gen.records import dataclass

Network = IPv4Network | IPv6Network
RELIABILITIES = ("reliable", "best_effort")
DURABILITIES = tuple(kind.value for kind in Durability)
HISTORIES = ("keep_last", "keep_all")
TOPIC_LISTS = ("publish", "subscribe")
OTHER_LISTS = ("call", "serve", "call_actions", "serve_actions")
LISTS = (*TOPIC_LISTS, *OTHER_LISTS)
"""Keys of a rule with the names that its clients may use."""
WORK = "work_ms_per_second"
CLIENT_LIMITS = (
    "objects",
    "streams",
    "message_bytes",
    "client_history_bytes",
    "object_history_bytes",
    "backlog_bytes",
    "requests",
    "messages_per_second",
    "operations_per_second",
)
"""Limits of the agent that count per client, which a rule can replace."""


@dataclass(frozen=True)
class Keys:
    """Client keys from `first` to `last`, both included."""

    first: int
    last: int
    span: Span | None = field(default=None, compare=False, repr=False)

    def __contains__(self, key: int) -> bool:
        return self.first <= key <= self.last

    def covers(self, other: Keys) -> bool:
        """Return whether all keys of `other` are in this range."""
        return self.first <= other.first and other.last <= self.last


@dataclass(frozen=True)
class QosRule:
    """Permitted values of QoS; None permits any. `depth`: greatest depth of keep_last, and then no keep_all."""

    reliability: tuple[str, ...] | None = None
    durability: tuple[str, ...] | None = None
    history: tuple[str, ...] | None = None
    depth: int | None = None


@dataclass(frozen=True)
class NameRule:
    """A pattern of absolute ROS names, what is permitted for them, or that they are refused."""

    pattern: str
    refuse: bool = False
    qos: QosRule = QosRule()
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class ClientRule:
    """What the clients with these keys, at these places, may do.

    Without `keys` it is for every key; without `addresses` and `devices` for every place. `domain` puts the clients
    into a ROS domain, `domains` are those that they may request (None: any). `nodes` are patterns of the names that
    their nodes may have (None: any). `lists` has the names of each key of `LISTS`. `graph`: whether they may observe
    the ROS graph. `limits` replace those of the agent, `work_ms` is the time of the agent per second (None: no limit).
    """

    name: str
    keys: tuple[Keys, ...] = ()
    addresses: tuple[Network, ...] = ()
    devices: tuple[str, ...] = ()
    refuse: bool = False
    domain: int | None = None
    domains: tuple[int, ...] | None = None
    nodes: tuple[NameRule, ...] | None = None
    lists: tuple[tuple[str, tuple[NameRule, ...]], ...] = ()
    graph: bool = False
    limits: tuple[tuple[str, float], ...] = ()
    work_ms: float | None = None
    span: Span | None = field(default=None, compare=False, repr=False)

    def names(self, key: str) -> tuple[NameRule, ...]:
        """Return the names in the list `key`."""
        return dict(self.lists).get(key, ())

    def find(self, key: str, name: str) -> NameRule | None:
        """Return the first entry of the list `key` that fits a name, or None."""
        return next((entry for entry in self.names(key) if matches(entry.pattern, name)), None)

    def permits_node(self, name: str) -> bool:
        """Return whether a node may have this fully qualified name."""
        return self.nodes is None or any(matches(entry.pattern, name) for entry in self.nodes)

    def limited(self, limits: Limits) -> Limits:
        """Return `limits` with those of the rule in their place."""
        own: dict[str, Any] = dict(self.limits)
        return replace(limits, **own) if own else limits

    @property
    def label(self) -> str:
        """Name and place, for people."""
        place = f" ({self.span.source.name}:{self.span.line})" if self.span else ""
        return f"'{self.name}'{place}"


@dataclass(frozen=True)
class Policy:
    """All rules of a file, in their order. A client that none of them is for is refused."""

    rules: tuple[ClientRule, ...] = ()
