# SPDX-License-Identifier: Apache-2.0
"""Objects that the agent creates for clients that create none (`entities: preconfigured`)."""

from __future__ import annotations

from dataclasses import field

from microros_gen.diagnostics import Span
from microros_gen.records import dataclass


@dataclass(frozen=True)
class PreconfiguredObject:
    """One object. `id` is (index << 4) | kind as in DDS-XRCE (clause 7.7), `parent` the id of its container.

    A participant has `name` and `domain`, a topic `name` and `type` (DDS names), a data writer or reader `topic` (an
    object id) and its QoS; `depth` 0 means the default of 1. A requester or replier has the `name` of its service and
    the DDS names of its types and topics; empty topic names are derived from the service's name.
    """

    id: int
    kind: str
    parent: int = 0
    name: str = ""
    domain: int = 0
    type: str = ""
    topic: int = 0
    reliable: bool = True
    durability: str = "volatile"
    keep_last: bool = True
    depth: int = 0
    request_type: str = ""
    reply_type: str = ""
    request_topic: str = ""
    reply_topic: str = ""
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class PreconfiguredClient:
    """The objects, containers first, of the client with `key` (4 bytes; None: every client without an entry).

    `adopt`: the client never opens its session again, so the agent accepts its samples without a session.
    """

    key: bytes | None
    objects: tuple[PreconfiguredObject, ...]
    adopt: bool = False
    span: Span | None = field(default=None, compare=False, repr=False)
