# SPDX-License-Identifier: Apache-2.0
"""Compares the limits of what is sent with those of the ends on other boards: what is longer would be lost."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.kinds import KIND
from microros_gen.application.limit_rule import LimitRule
from microros_gen.application.model import Application, EndpointDecl
from microros_gen.application.system_decl import BusSender, Link, PeerEnd
from microros_gen.application.system_find import client_key
from microros_gen.client.plan.declared import type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.service_limits import part_rules
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import Message, NamedType, TypeName, element_of
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.capacity import Defaults, Root, plan_capacities
from microros_gen.typesupport.plan.size import TypeLimits, WireSizes

_NONE, _ANY = Defaults(0, 0), Defaults(1 << 31, 1 << 31)
"""Where nothing says how long a field of the other board is: its own build reports that."""


@dataclass(frozen=True)
class Longer:
    """A field whose values may be longer in the publisher's messages: `sent` and `taken` characters or elements."""

    path: str
    unit: str
    sent: int
    taken: int


@dataclass(frozen=True)
class LimitedEnds:
    """Both ends of one direction: the `index`-th endpoint of its kind, and `end` of the board of `link`.

    `message`: what is exchanged; `sends`: this board sends it.
    """

    endpoint: EndpointDecl
    index: int
    end: PeerEnd
    link: Link
    message: TypeName
    sends: bool


def check_limits(ends: LimitedEnds, context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report the fields that the sender of a message fills further than the other end has room for."""
    end, kind = ends.end, ends.endpoint.kind
    messages = {known: plan.message for known, plan in context.types.items()}
    own = context.types[ends.message].limits_of(kind, ends.index)
    other = _limits_of(end, ends.link.limits, ends.message, messages, _ANY if ends.sends else _NONE)
    sent, taken = (own, other) if ends.sends else (other, own)
    for longer in _longer(ends.message, sent, taken, messages, ""):
        place = f" ({end.span.source.name}:{end.span.line})" if end.span else ""
        theirs = f"the {end.kind} of the board '{ends.link.board}'{place}"
        writer, reader = (f"the {kind}", theirs) if ends.sends else (theirs, f"the {kind}")
        message = (
            f"'{longer.path}' of '{end.topic}': up to {longer.sent} {longer.unit} from {writer}, and "
            f"{longer.taken} fit {reader}"
        )
        hint = "Write the same `limits:` in both applications"
        diagnostics.error(message, ends.endpoint.span, hint, id="MG-7206")


def check_client_keys(application: Application, diagnostics: Diagnostics) -> None:
    """Warn of boards that an agent cannot tell apart."""
    own = client_key(application)
    for link in application.links:
        if own is not None and link.client_key == own:
            diagnostics.warning(
                f"the board '{link.board}' has the same client key {own}: at one agent, each would take over the "
                "session of the other one",
                application.spans.get("session") or link.span,
                "Give each board its own `session: {key: N}`",
                id="MG-7207",
            )


def sent_body(end: PeerEnd, link: Link, name: TypeName, messages: dict[TypeName, Message]) -> int:
    """Return the bytes of the largest body of a message that an endpoint of the board of `link` sends."""
    return WireSizes(messages).largest(name, _limits_of(end, link.limits, name, messages, _NONE))


def bus_body(end: PeerEnd, sender: BusSender) -> int:
    """Return the bytes of the largest body of a message that a publisher of `sender` sends."""
    name, messages = type_name(end.type), dict(sender.messages)
    return WireSizes(messages).largest(name, _limits_of(end, sender.limits, name, messages, _NONE))


def _limits_of(
    end: PeerEnd,
    limits: tuple[LimitRule, ...],
    name: TypeName,
    messages: dict[TypeName, Message],
    defaults: Defaults,
) -> TypeLimits | None:
    """Return the limits of an endpoint of the other board; faults of its application are reported where it is built.

    `limits`: those of its application; `defaults`: for what has no limit there.
    """
    rules = end.limits
    if KIND[end.kind].service_type:
        rules = part_rules(rules, type_name(end.type, "srv"), name.name.rpartition("_")[2], messages)
    found = plan_capacities(messages, (Root(name, rules),), limits, defaults, Diagnostics())
    return found.limits[name]


def _longer(
    name: TypeName,
    sent: TypeLimits | None,
    taken: TypeLimits | None,
    messages: dict[TypeName, Message],
    above: str,
) -> Iterator[Longer]:
    """Yield what differs, field by field; both limits are of the same type."""
    if sent is None or taken is None:
        return
    for field, writer, reader in zip(messages[name].fields, sent.fields, taken.fields, strict=True):
        if writer is None or reader is None:
            continue
        path = f"{above}{field.name}"
        for unit, most, room in (
            ("elements", writer.sequence, reader.sequence),
            ("characters", writer.string, reader.string),
        ):
            if most is not None and room is not None and most > room:
                yield Longer(path, unit, most, room)
        element = element_of(field.type)
        if isinstance(element, NamedType):
            yield from _longer(element.name, writer.nested, reader.nested, messages, f"{path}.")
