# SPDX-License-Identifier: Apache-2.0
"""A proposed application file: what was found somewhere else, and what could not be decided there."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field
from types import MappingProxyType

from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.records import dataclass

Setting = str | int | bool
"""A value of the application file. A text is quoted where YAML needs it, unless it is a `Flow`."""


class Flow(str):
    """YAML that is written as it is: `{type: udp}`, `block 1 s`."""


@dataclass(frozen=True)
class Remark:
    """What somebody must know of one thing that was read; `text` says what and why.

    `undecided`: somebody must decide; otherwise it is something that has no place in the application file. `refused`:
    with this the program does not build; what to do about it.
    """

    text: str
    span: Span | None = None
    undecided: bool = True
    refused: str = ""


@dataclass(frozen=True)
class DraftQos:
    """What differs from the default QoS: keys of `qos` in the application file."""

    settings: Mapping[str, Setting] = field(default_factory=lambda: MappingProxyType({}))


@dataclass(frozen=True)
class DraftEndpoint:
    """A publisher, subscription, service or client (`kind`). `name` or `type` empty: not known, see the remarks."""

    kind: str
    name: str
    type: str
    qos: DraftQos = DraftQos()
    span: Span | None = None
    remarks: tuple[Remark, ...] = ()


@dataclass(frozen=True)
class DraftTimer:
    """A timer; `period_ns` None: not known."""

    name: str
    period_ns: int | None
    span: Span | None = None
    remarks: tuple[Remark, ...] = ()


@dataclass(frozen=True)
class DraftClient:
    """Another node whose parameters are used; empty: not known. `settings`: the other keys of `parameter_clients`."""

    node: str
    settings: Mapping[str, Setting] = field(default_factory=lambda: MappingProxyType({}))
    span: Span | None = None
    remarks: tuple[Remark, ...] = ()


@dataclass(frozen=True)
class DraftAction:
    """An action server, or a client. `name` or `type` empty: not known, see the remarks."""

    name: str
    type: str
    goals: int = 1
    is_client: bool = False
    span: Span | None = None
    remarks: tuple[Remark, ...] = ()


@dataclass(frozen=True)
class DraftNode:
    """A node and what it owns; `name` empty: not known.

    `at_agent`: its parameters are held there, `may_be_at_agent`: they can be.
    """

    name: str
    namespace: str = ""
    domain_id: int = 0
    endpoints: tuple[DraftEndpoint, ...] = ()
    timers: tuple[DraftTimer, ...] = ()
    clients: tuple[DraftClient, ...] = ()
    actions: tuple[DraftAction, ...] = ()
    at_agent: bool = False
    may_be_at_agent: bool = False
    span: Span | None = None
    remarks: tuple[Remark, ...] = ()


@dataclass(frozen=True)
class DraftValue:
    """A value and why it is so: `note` becomes a comment after it."""

    value: Setting
    note: str = ""


@dataclass(frozen=True)
class Draft:
    """The whole proposal. `limits` are keys of the table `limits` with their text; `groups` are mappings by their key.

    `groups` holds `transport`, `session`, `pools`, `memory`; `settings` the other keys of the top level.
    `suggestions` are lines that stand at its end as comments.
    """

    profiles: tuple[str, ...] = ()
    components: tuple[str, ...] = ()
    interfaces: tuple[str, ...] = ()
    nodes: tuple[DraftNode, ...] = ()
    settings: Mapping[str, DraftValue] = field(default_factory=lambda: MappingProxyType({}))
    groups: Mapping[str, Mapping[str, DraftValue]] = field(default_factory=lambda: MappingProxyType({}))
    limits: Mapping[str, DraftValue] = field(default_factory=lambda: MappingProxyType({}))
    remarks: tuple[Remark, ...] = ()
    suggestions: tuple[str, ...] = ()

    @property
    def all_remarks(self) -> tuple[Remark, ...]:
        """The remarks of the application, its nodes and all that they own."""
        found = list(self.remarks)
        for node in self.nodes:
            found += node.remarks
            found += [remark for endpoint in node.endpoints for remark in endpoint.remarks]
            found += [remark for timer in node.timers for remark in timer.remarks]
            found += [remark for client in node.clients for remark in client.remarks]
            found += [remark for action in node.actions for remark in action.remarks]
        return tuple(found)


def report_remarks(remarks: Iterable[Remark], diagnostics: Diagnostics) -> None:
    """Add what somebody must decide: an error where a program does not build with it, else a warning."""
    for remark in remarks:
        report = diagnostics.error if remark.refused else diagnostics.warning
        report(remark.text, remark.span, remark.refused or None, id="MG-9099")


def place(span: Span | None) -> str:
    """Return `file:line` as comments print it; empty without a place."""
    return f"{span.source.name}:{span.line}" if span else ""
