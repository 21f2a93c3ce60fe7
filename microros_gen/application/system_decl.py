# SPDX-License-Identifier: Apache-2.0
"""Boards that exchange messages without an agent, as a system file declares them, seen from one of them."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

from microros_gen.application.limit_rule import LimitRule
from microros_gen.diagnostics import Span
from microros_gen.documents.named import Named
from microros_gen.interfaces.types import Message, TypeName
from microros_gen.records import dataclass


@dataclass(frozen=True)
class SystemRef:
    """`system:` of an application: the path of the system file, relative to the application's, and this board."""

    file: Named
    board: Named


@dataclass(frozen=True)
class PeerEnd:
    """An endpoint of another board. `topic` is fully qualified; of a service or client it is the service's name.

    `type_hash` is what its own interface files give; None: they are looked for where those of this board are. `limits`
    are its own. `queue`: requests or replies that wait; None: as many as without the key. `interval_us`: a publisher
    publishes at most once in that time, as `rate_span` says.
    """

    kind: str
    domain_id: int
    topic: str
    type: str
    reliability: str
    peer: str
    span: Span | None = None
    type_hash: str | None = None
    limits: tuple[LimitRule, ...] = ()
    queue: int | None = None
    interval_us: Fraction | None = None
    rate_span: Span | None = None


@dataclass(frozen=True)
class ChipDecl:
    """A chip of a system file: the boards that are its images, in their order, and the bytes of its shared memory.

    `memory` None: the file does not say it. `span`: where it does.
    """

    images: tuple[Named, ...]
    memory: int | None = None
    span: Span | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """Return the names of the boards."""
        return tuple(image.name for image in self.images)


@dataclass(frozen=True)
class LinkDecl:
    """A link of a system file; `ends` are its boards, each with its address or device. Only CAN FD has more than two.

    `can_id`: the least identifier of CAN FD, to which the numbers of the boards are added.
    """

    kind: str
    ends: tuple[tuple[str, Named], ...]
    mtu: int
    history: int
    span: Span
    can_id: int = 0


@dataclass(frozen=True)
class CanFrames:
    """The extended identifiers of the frames that a board sends to and receives from another one.

    `bitrate` of the bus in the application of the other board; None: it says none.
    """

    sent: int
    received: int
    bitrate: int | None


@dataclass(frozen=True)
class Link:
    """A link to another board, `board`; `position`: whether this one is its first (0) or second end.

    `kind` is udp, serial or canfd. `own` and `other` are the addresses of the two ends, or the names of their
    devices; `can`: what CAN FD has besides. `mtu`: largest message, bytes; `history`: messages that wait until they are
    acknowledged. `baud` of the other board's line. `files` were read for it. `limits` are those of the other
    application, `client_key` is what it declares for the session with its agent; None: it has none, or declares none.
    `round_trip` and `heartbeat` are what its `session:` says, milliseconds; None: nothing.
    """

    kind: str
    board: str
    position: int
    own: Named
    other: Named
    mtu: int
    history: int
    baud: int
    transport: str
    ends: tuple[PeerEnd, ...]
    files: tuple[Path, ...] = ()
    span: Span | None = None
    limits: tuple[LimitRule, ...] = ()
    client_key: int | None = None
    round_trip: int | None = None
    heartbeat: int | None = None
    can: CanFrames | None = None


@dataclass(frozen=True)
class BusSender:
    """What `board` sends on a CAN bus at the controller `device` of this board, and not to this board.

    `receiver`: another board; None: its agent. `publishers` are those with a rate, `messages` their types with all that
    these contain. `mtu`: largest message, bytes. `limits`, `round_trip` and `heartbeat` as those of a link.
    """

    device: str
    board: str
    receiver: str | None
    publishers: tuple[PeerEnd, ...]
    messages: Mapping[TypeName, Message]
    mtu: int
    limits: tuple[LimitRule, ...]
    round_trip: int | None
    heartbeat: int | None
