# SPDX-License-Identifier: Apache-2.0
"""The rules of `local: chip`: one end of a topic or service in each of two images.

They agree about its messages and its rings.
"""

from __future__ import annotations

from microros_gen.application.kinds import KIND, NAMES, other_end
from microros_gen.application.model import Application, ChipImage, EndpointDecl
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.service_limits import part_rules
from microros_gen.components.local_delivery.check import MOST_SLOTS
from microros_gen.components.local_delivery.shared import slots_of
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.derived import derived_name
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.capacity import Defaults, Root, plan_capacities
from microros_gen.typesupport.plan.size import TypeLimits

Key = tuple[int, str, bool]
"""Domain and name, and whether that is the name of a service."""

_VERBS = dict(zip(NAMES, ("publish", "subscribe to", "serve", "call"), strict=True))
"""What a node does with the name of an endpoint of each kind."""


@dataclass(frozen=True)
class _End:
    """An endpoint, and its index among those of its kind."""

    index: int
    endpoint: EndpointDecl

    @property
    def missing(self) -> str:
        """Return what the other image has to do with its name."""
        return _VERBS[other_end(self.endpoint.kind)]

    @property
    def types(self) -> tuple[TypeName, ...]:
        """Return the types of its messages: two of a service."""
        return _messages(self.endpoint)

    def limits(self, context: PlanContext) -> tuple[TypeLimits | None, ...]:
        """Return the limits of its messages."""
        known = (context.types[name] for name in self.types)
        return tuple(type_.limits_of(self.endpoint.kind, self.index) for type_ in known)


@dataclass(frozen=True)
class _Pair:
    """The two ends of a topic or service; `other` is that of the other image."""

    topic: str
    own: _End
    other: EndpointDecl
    image: ChipImage

    @property
    def shown(self) -> str:
        """Return what messages call the other end."""
        span = self.other.span
        place = f" ({span.source.name}:{span.line})" if span else ""
        return f"the {self.other.kind} of the board '{self.image.board}'{place}"


def check_shared(context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report topics and services between images that have other ends than one in each, or ends that do not agree."""
    _check_single(context.application, diagnostics)
    own = _ends(context.application)
    if not own:
        return
    first = next(iter(own.values())).endpoint
    system, image = context.application.system, context.application.chip
    if system is None:
        diagnostics.error(
            "`local: chip` needs the system that the other image is in",
            first.span,
            "Write `system: {file: system.yaml, board: NAME}`",
            id="MG-7242",
        )
    elif image is None:
        message = f"no chip of the system has the board '{system.board.name}'"
        hint = "Write `chips: [[FIRST, SECOND]]` in the system, with this board and that of the other image"
        diagnostics.error(message, system.board.span, hint, id="MG-7243")
    else:
        _check_image(own, image, context, diagnostics)


def _ends(application: Application) -> dict[Key, _End]:
    """Return the ends of topics and services between images."""
    return {
        (node.domain_id, full_name(node, endpoint), KIND[kind].service_type): _End(index, endpoint)
        for kind in NAMES
        for index, (_, node, endpoint) in enumerate(declarations(application, kind))
        if endpoint.local == "chip"
    }


def _messages(endpoint: EndpointDecl) -> tuple[TypeName, ...]:
    """Return the types of what an endpoint sends and receives."""
    kind = KIND[endpoint.kind]
    name = type_name(endpoint.type, kind.type_kind)
    return tuple(derived_name(name, part) if part else name for part, _ in kind.parts)


def _check_single(application: Application, diagnostics: Diagnostics) -> None:
    """Report names between images that have more than one end in this one, and rings that are too long."""
    seen: dict[Key, EndpointDecl] = {}
    for kind in NAMES:
        what = "service" if KIND[kind].service_type else "topic"
        for _, node, endpoint in declarations(application, kind):
            topic = full_name(node, endpoint)
            other = seen.setdefault((node.domain_id, topic, KIND[kind].service_type), endpoint)
            if other is not endpoint and "chip" in (other.local, endpoint.local):
                diagnostics.error(
                    f"a {what} between two images has one end in each: '{topic}' has two in this one",
                    endpoint.span,
                    "Write `local: only` at both, or rename one",
                    id="MG-7240",
                )
            if endpoint.local == "chip" and endpoint.qos.depth > MOST_SLOTS:
                diagnostics.error(
                    f"{endpoint.qos.depth} messages of '{topic}' are more than the {MOST_SLOTS} of a ring",
                    endpoint.qos.span or endpoint.span,
                    f"Write `qos: {{depth: {MOST_SLOTS}}}` or less",
                    id="MG-7250",
                )


def _check_image(
    own: dict[Key, _End], image: ChipImage, context: PlanContext, diagnostics: Diagnostics
) -> None:
    """Report ends that the other one of the two images does not have, and what two ends do not agree about."""
    others = _ends(image.application)
    for key, end in own.items():
        other = others.get(key)
        if other is None or other.endpoint.kind == end.endpoint.kind:
            message = (
                f"the other image of the chip, '{image.board}', does not {end.missing} '{key[1]}' over it"
            )
            hint = "Write `local: chip` at the other end, too, or remove it here"
            diagnostics.error(message, end.endpoint.span, hint, id="MG-7244")
        else:
            _check_pair(_Pair(key[1], end, other.endpoint, image), context, diagnostics)
    for key, other in others.items():
        if key not in own:
            message = f"the other image of the chip does not {other.missing} '{key[1]}' over it"
            hint = "Declare its other end there with `local: chip`, or remove `local: chip` here"
            diagnostics.error(message, other.endpoint.span, hint, id="MG-7251")


def _check_pair(pair: _Pair, context: PlanContext, diagnostics: Diagnostics) -> None:
    own, other, topic = pair.own.endpoint, pair.other, pair.topic
    kind = KIND[own.kind]
    name, others = type_name(own.type, kind.type_kind), type_name(other.type, kind.type_kind)
    if name != others:
        message = f"'{topic}' has the type {name} here, and {pair.shown} has {others}"
        diagnostics.error(message, own.type_span or own.span, "Give both the same type", id="MG-7245")
        return
    hashes = pair.image.hashes
    if any(hashes.get(str(part)) not in (None, context.types[part].type_hash) for part in pair.own.types):
        message = f"{name} is defined otherwise than for {pair.shown}: their type hashes differ"
        hint = "Use the same interface files for both images"
        diagnostics.error(message, own.type_span or own.span, hint, id="MG-7246")
        return
    writer, reader = (own, other) if own.kind == "publisher" else (other, own)
    if (
        not kind.service_type
        and reader.qos.reliability == "reliable"
        and writer.qos.reliability != "reliable"
    ):
        needs = "is best effort" if own is writer else "is reliable"
        message = f"'{topic}' {needs} here and never matches {pair.shown}"
        hint = "Write `qos: {reliability: best_effort}` at the subscription"
        diagnostics.error(message, own.qos.span or own.span, hint, id="MG-7247")
    if slots_of(own) != slots_of(other):
        message = (
            f"the ring of '{topic}' has {slots_of(own)} slots here and {slots_of(other)} for {pair.shown}"
        )
        hint = (
            "Write the same `queue` at both"
            if kind.service_type
            else "Write the same `qos: {depth: …}` at both"
        )
        diagnostics.error(message, own.qos.span or own.span, hint, id="MG-7248")
    if pair.own.limits(context) != _limits(pair, context):
        message = f"the limits of '{topic}' differ from those of {pair.shown}"
        hint = "Write the same `limits:` at both, or by the type"
        diagnostics.error(message, own.span, hint, id="MG-7249")


def _limits(pair: _Pair, context: PlanContext) -> tuple[TypeLimits | None, ...]:
    """Return the limits of the other end, whose type is that of this one; what is wrong with them its build reports."""
    messages = {name: known.message for name, known in context.types.items()}
    kind, rules = KIND[pair.other.kind], pair.image.application.limits
    name = type_name(pair.other.type, kind.type_kind)
    found = []
    for type_, (part, _) in zip(pair.own.types, kind.parts, strict=True):
        own = part_rules(pair.other.limits, name, part, messages) if part else pair.other.limits
        root = Root(type_, own, pair.other.span)
        planned = plan_capacities(messages, [root], rules, Defaults(None, None), Diagnostics())
        found.append(planned.limits[type_])
    return tuple(found)
