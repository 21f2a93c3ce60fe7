# SPDX-License-Identifier: Apache-2.0
"""The rules of `local: chip`: one end of a topic in each of two images, which agree about its messages and its ring."""

from __future__ import annotations

from microros_gen.application.kinds import SERVICE_KINDS, TOPIC_KINDS
from microros_gen.application.model import Application, ChipImage, EndpointDecl
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.local_delivery.check import MOST_SLOTS, End
from microros_gen.components.local_delivery.shared import slots_of
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.capacity import Defaults, Root, plan_capacities
from microros_gen.typesupport.plan.size import TypeLimits

Key = tuple[int, str]
"""Domain and name of a topic."""


@dataclass(frozen=True)
class _Pair:
    """The two ends of a topic; `other` is that of the other image."""

    topic: str
    own: End
    other: EndpointDecl
    image: ChipImage

    @property
    def shown(self) -> str:
        """Return what messages call the other end."""
        span = self.other.span
        place = f" ({span.source.name}:{span.line})" if span else ""
        return f"the {self.other.kind} of the board '{self.image.board}'{place}"


def check_shared(context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report topics between images that have other ends than one in each, or ends that do not agree."""
    _check_services(context.application, diagnostics)
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


def _ends(application: Application) -> dict[Key, End]:
    """Return the ends of topics between images."""
    return {
        (node.domain_id, full_name(node, endpoint)): End(index, endpoint)
        for kind in TOPIC_KINDS
        for index, (_, node, endpoint) in enumerate(declarations(application, kind))
        if endpoint.local == "chip"
    }


def _check_services(application: Application, diagnostics: Diagnostics) -> None:
    for kind in SERVICE_KINDS:
        for _, node, endpoint in declarations(application, kind):
            if endpoint.local == "chip":
                diagnostics.error(
                    f"services are not between two images: '{full_name(node, endpoint)}' has `local: chip`",
                    endpoint.span,
                    "Use topics in both directions, or `local: only`",
                    id="MG-7241",
                )


def _check_single(application: Application, diagnostics: Diagnostics) -> None:
    """Report topics between images that have more than one end in this one, and rings that are too long."""
    seen: dict[Key, EndpointDecl] = {}
    for kind in TOPIC_KINDS:
        for _, node, endpoint in declarations(application, kind):
            topic = full_name(node, endpoint)
            other = seen.setdefault((node.domain_id, topic), endpoint)
            if other is not endpoint and "chip" in (other.local, endpoint.local):
                diagnostics.error(
                    f"a topic between two images has one end in each: '{topic}' has two in this one",
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
    own: dict[Key, End], image: ChipImage, context: PlanContext, diagnostics: Diagnostics
) -> None:
    """Report ends that the other one of the two images does not have, and what two ends do not agree about."""
    others = {key: end.endpoint for key, end in _ends(image.application).items()}
    for key, end in own.items():
        other = others.get(key)
        if other is None or other.kind == end.endpoint.kind:
            missing = "subscribe to" if end.publishes else "publish"
            message = f"the other image of the chip, '{image.board}', does not {missing} '{key[1]}' over it"
            hint = "Write `local: chip` at the other end, too, or remove it here"
            diagnostics.error(message, end.endpoint.span, hint, id="MG-7244")
        else:
            _check_pair(_Pair(key[1], end, other, image), context, diagnostics)
    for key, other in others.items():
        if key not in own:
            missing = "subscribe to" if other.kind == "publisher" else "publish"
            message = f"the other image of the chip does not {missing} '{key[1]}' over it"
            hint = "Declare its other end there with `local: chip`, or remove `local: chip` here"
            diagnostics.error(message, other.span, hint, id="MG-7251")


def _check_pair(pair: _Pair, context: PlanContext, diagnostics: Diagnostics) -> None:
    own, other, topic = pair.own.endpoint, pair.other, pair.topic
    name, others = type_name(own.type), type_name(other.type)
    if name != others:
        message = f"'{topic}' has the type {name} here, and {pair.shown} has {others}"
        diagnostics.error(message, own.type_span or own.span, "Give both the same type", id="MG-7245")
        return
    type_hash = pair.image.hashes.get(str(others))
    if type_hash not in (None, context.types[name].type_hash):
        message = f"{name} is defined otherwise than for {pair.shown}: their type hashes differ"
        hint = "Use the same interface files for both images"
        diagnostics.error(message, own.type_span or own.span, hint, id="MG-7246")
        return
    writer, reader = (own, other) if pair.own.publishes else (other, own)
    if reader.qos.reliability == "reliable" and writer.qos.reliability != "reliable":
        needs = "is best effort" if pair.own.publishes else "is reliable"
        message = f"'{topic}' {needs} here and never matches {pair.shown}"
        hint = "Write `qos: {reliability: best_effort}` at the subscription"
        diagnostics.error(message, own.qos.span or own.span, hint, id="MG-7247")
    if slots_of(own) != slots_of(other):
        message = (
            f"the ring of '{topic}' has {slots_of(own)} slots here and {slots_of(other)} for {pair.shown}"
        )
        hint = "Write the same `qos: {depth: …}` at both"
        diagnostics.error(message, own.qos.span or own.span, hint, id="MG-7248")
    if pair.own.limits(context.types) != _limits(pair, context):
        message = f"the limits of '{topic}' differ from those of {pair.shown}"
        hint = "Write the same `limits:` at both, or by the type"
        diagnostics.error(message, own.span, hint, id="MG-7249")


def _limits(pair: _Pair, context: PlanContext) -> TypeLimits | None:
    """Return the limits of the other end, whose type is that of this one; what is wrong with them its build reports."""
    messages = {name: known.message for name, known in context.types.items()}
    name = type_name(pair.other.type)
    root = Root(name, pair.other.limits, pair.other.span)
    rules = pair.image.application.limits
    return plan_capacities(messages, [root], rules, Defaults(None, None), Diagnostics()).limits[name]
