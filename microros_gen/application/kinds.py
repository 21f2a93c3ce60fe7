# SPDX-License-Identifier: Apache-2.0
"""The kinds of entities that a node declares: one table, which every other module goes through."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from microros_gen.records import dataclass


@dataclass(frozen=True, kw_only=True)
class EntityKind:
    """A kind of entity, in the order in which tables of the client have their places.

    `key`: its list in the application file, in `pools` and in the manifest. `component` is what it needs in order to be
    created, `does` how the summary calls what it does. A `service_type` has two messages: a request and a response.
    `sends`, `receives`: what it writes and reads, as suffixes of the names of messages (none for a message's own name).
    `waited`: a wait set and an executor can wait for it.
    """

    name: str
    key: str
    component: str
    does: str
    service_type: bool = False
    sends: tuple[str, ...] = ()
    receives: tuple[str, ...] = ()
    waited: bool = False

    @property
    def type_kind(self) -> str:
        """`msg` or `srv`: the folder of its type."""
        return "srv" if self.service_type else "msg"

    @property
    def name_key(self) -> str:
        """The key of its name in the application file."""
        return "name" if self.service_type else "topic"

    @property
    def parts(self) -> tuple[tuple[str, bool], ...]:
        """Each message that it exchanges: its suffix, and whether it sends that; the first one goes to the server."""
        return tuple((suffix, suffix in self.sends) for suffix in sorted((*self.sends, *self.receives)))


KINDS = (
    EntityKind(
        name="publisher",
        key="publishers",
        component="publish",
        does="publishes",
        sends=("",),
    ),
    EntityKind(
        name="subscription",
        key="subscriptions",
        component="subscribe",
        does="receives",
        receives=("",),
        waited=True,
    ),
    EntityKind(
        name="service",
        key="services",
        component="services",
        does="serves",
        service_type=True,
        sends=("Response",),
        receives=("Request",),
        waited=True,
    ),
    EntityKind(
        name="client",
        key="clients",
        component="services",
        does="calls",
        service_type=True,
        sends=("Request",),
        receives=("Response",),
        waited=True,
    ),
)
KIND: Mapping[str, EntityKind] = MappingProxyType({kind.name: kind for kind in KINDS})
"""The kinds by name."""
NAMES = tuple(KIND)
SERVICE_KINDS = tuple(kind.name for kind in KINDS if kind.service_type)
TOPIC_KINDS = tuple(kind.name for kind in KINDS if not kind.service_type)
RECEIVING = tuple(kind for kind in KINDS if kind.receives)
"""Those that receive, in the order of their places."""


def other_end(kind: str) -> str:
    """Return the kind that receives what a kind sends, or sends what it receives."""
    kinds = SERVICE_KINDS if KIND[kind].service_type else TOPIC_KINDS
    return next(other for other in kinds if other != kind)
