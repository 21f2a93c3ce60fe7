# SPDX-License-Identifier: Apache-2.0
"""The rules of `local: chip`: a topic or service has at most one end in each image of a chip.

Its ends agree about its messages and its rings.
"""

from __future__ import annotations

from microros_gen.application.kinds import KIND, NAMES, other_end
from microros_gen.application.model import Application, Chip, EndpointDecl
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.local_delivery.check import MOST_SLOTS
from microros_gen.components.local_delivery.chip_ends import ChipEnd, Key, limits_of, other_ends, own_ends
from microros_gen.components.local_delivery.shared import WORD, ChipRing, SharedRing
from microros_gen.diagnostics import Diagnostics

MOST_RINGS = 255
"""Of an image: C counts them in a byte."""


def check_shared(context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report topics and services between images that have other ends than one in each, or ends that do not agree."""
    _check_single(context.application, diagnostics)
    own = own_ends(context)
    if not own:
        return
    system, chip = context.application.system, context.application.chip
    if system is None:
        diagnostics.error(
            "`local: chip` needs the system that the other image is in",
            own[0].endpoint.span,
            "Write `system: {file: system.yaml, board: NAME}`",
            id="MG-7242",
        )
    elif chip is None:
        message = f"no chip of the system has the board '{system.board.name}'"
        hint = "Write `chips: [[FIRST, SECOND]]` in the system, with this board and those of the other images"
        diagnostics.error(message, system.board.span, hint, id="MG-7243")
    else:
        _check_images(own, chip, context, diagnostics)


def check_memory(rings: tuple[ChipRing, ...], application: Application, diagnostics: Diagnostics) -> None:
    """Report rings that need more than the shared memory has."""
    chip = application.chip
    needed = max((ring.end for ring in rings), default=0) * WORD
    if chip is not None and chip.memory is not None and needed > chip.memory:
        diagnostics.too_large(
            f"the rings of the chip need {needed} bytes of shared memory, which has {chip.memory}",
            chip.span,
            f"Write `memory: {needed}`, or lower depths, queues or limits of what has `local: chip`",
            id="MG-7280",
        )


def check_count(rings: tuple[SharedRing, ...], diagnostics: Diagnostics) -> None:
    """Report more rings than an image can have."""
    if len(rings) > MOST_RINGS:
        last = rings[MOST_RINGS].ring
        end = next(end for end in last.pair if end.position != rings[MOST_RINGS].other)
        diagnostics.error(
            f"the image has {len(rings)} rings in the shared memory, and {MOST_RINGS} is the most",
            end.endpoint.span,
            "Declare fewer topics and services with `local: chip`: each has a ring for each other end, a service two",
            id="MG-7282",
        )


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
                    f"a {what} between images has one end in each: '{topic}' has two in this one",
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


def _check_images(
    own: tuple[ChipEnd, ...], chip: Chip, context: PlanContext, diagnostics: Diagnostics
) -> None:
    """Report ends whose other ends no image has, and what the ends of a topic or service do not agree about."""
    others = other_ends(chip)
    for end in own:
        found = [other for other in others if end.matches(other)]
        if not found:
            message = f"'{end.name}' has no {other_end(end.endpoint.kind)} in any other image of the chip"
            hint = "Write `local: chip` at the other end, too, or remove it here"
            diagnostics.error(message, end.endpoint.span, hint, id="MG-7244")
        for other in found:
            _check_pair(end, other, chip, context, diagnostics)
        _check_servers(end, [other for other in others if other.key == end.key], diagnostics)
    for other in others:
        if not any(other.matches(end) for end in (*own, *others)):
            message = f"'{other.name}' has no {other_end(other.endpoint.kind)} in any other image of the chip"
            hint = "Declare its other end there with `local: chip`, or remove `local: chip` here"
            diagnostics.error(message, other.endpoint.span, hint, id="MG-7251")


def _check_servers(end: ChipEnd, others: list[ChipEnd], diagnostics: Diagnostics) -> None:
    """Report a service that several images serve."""
    servers = [each for each in (end, *others) if each.endpoint.kind == "service"]
    if len(servers) > 1:
        names = " and ".join(
            f"'{server.board}'" for server in sorted(servers, key=lambda each: each.position)
        )
        diagnostics.error(
            f"a service has one server on a chip: '{end.name}' is served by {names}",
            end.endpoint.span,
            "Rename it in one of them",
            id="MG-7281",
        )


def _check_pair(
    own: ChipEnd, other: ChipEnd, chip: Chip, context: PlanContext, diagnostics: Diagnostics
) -> None:
    """Report what two ends do not agree about."""
    image = next(image for image in chip.images if image.position == other.position)
    end, topic, kind = own.endpoint, own.name, KIND[own.endpoint.kind]
    name, others = type_name(end.type, kind.type_kind), type_name(other.endpoint.type, kind.type_kind)
    if name != others:
        message = f"'{topic}' has the type {name} here, and {other.shown} has {others}"
        diagnostics.error(message, end.type_span or end.span, "Give both the same type", id="MG-7245")
        return
    types = [type_ for _, type_, _ in own.parts]
    if any(image.hashes.get(str(type_)) not in (None, context.types[type_].type_hash) for type_ in types):
        message = f"{name} is defined otherwise than for {other.shown}: their type hashes differ"
        hint = "Use the same interface files for all images"
        diagnostics.error(message, end.type_span or end.span, hint, id="MG-7246")
        return
    _check_qos(own, other, diagnostics)
    if own.slots != other.slots:
        message = f"the ring of '{topic}' has {own.slots} slots here and {other.slots} for {other.shown}"
        key = "`queue`" if kind.service_type else "`qos: {depth: …}`"
        diagnostics.error(message, end.qos.span or end.span, f"Write the same {key} at both", id="MG-7248")
    limits = tuple(context.types[type_].limits_of(end.kind, own.index) for type_ in types)
    messages = {type_: known.message for type_, known in context.types.items()}
    if limits != limits_of(other, image, messages):
        message = f"the limits of '{topic}' differ from those of {other.shown}"
        hint = "Write the same `limits:` at both, or by the type"
        diagnostics.error(message, end.span, hint, id="MG-7249")


def _check_qos(own: ChipEnd, other: ChipEnd, diagnostics: Diagnostics) -> None:
    """Report a reliable subscription of a best effort publisher."""
    writer, reader = (own, other) if own.endpoint.kind == "publisher" else (other, own)
    if (
        not KIND[own.endpoint.kind].service_type
        and reader.endpoint.qos.reliability == "reliable"
        and writer.endpoint.qos.reliability != "reliable"
    ):
        needs = "is best effort" if own is writer else "is reliable"
        message = f"'{own.name}' {needs} here and never matches {other.shown}"
        hint = "Write `qos: {reliability: best_effort}` at the subscription"
        diagnostics.error(message, own.endpoint.qos.span or own.endpoint.span, hint, id="MG-7247")
