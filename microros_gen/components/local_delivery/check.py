# SPDX-License-Identifier: Apache-2.0
"""The rules of `local:`: the ends of a topic inside one image have to agree, and what local delivery does not carry."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.application.model import EndpointDecl
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.size import TypeLimits
from microros_gen.typesupport.plan.types import TypePlan

MOST_SLOTS = 254


@dataclass(frozen=True)
class End:
    """An endpoint of a topic, and its index among those of its kind."""

    index: int
    endpoint: EndpointDecl

    @property
    def publishes(self) -> bool:
        """Return whether it is a publisher."""
        return self.endpoint.kind == "publisher"

    def limits(self, types: Mapping[TypeName, TypePlan]) -> TypeLimits | None:
        """Return the limits of its messages."""
        return types[type_name(self.endpoint.type)].limits_of(self.endpoint.kind, self.index)


def check_topics(context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report each topic with a local end whose ends do not agree, and what its messages would lose."""
    topics: dict[tuple[int, str], list[End]] = {}
    for kind in ("publisher", "subscription"):
        for index, (_, node, endpoint) in enumerate(declarations(context.application, kind)):
            if endpoint.local == "chip":
                _check_qos(full_name(node, endpoint), End(index, endpoint), diagnostics)
            else:
                topics.setdefault((node.domain_id, full_name(node, endpoint)), []).append(
                    End(index, endpoint)
                )
    if all(end.local == "never" for node in context.application.nodes for end in node.endpoints):
        diagnostics.error(
            "the component 'local_delivery' is for endpoints with `local:`",
            context.application.spans.get("components"),
            "Write `local: only` at a publisher and a subscription, or remove the component",
            id="MG-7178",
        )
    for (_, topic), ends in topics.items():
        local = [end for end in ends if end.endpoint.local != "never"]
        if local:
            _check_ends(topic, ends, local[0], diagnostics)
            for end in local:
                _check_qos(topic, end, diagnostics)
            _check_pairs(topic, local, context.types, diagnostics)


def _check_ends(topic: str, ends: list[End], local: End, diagnostics: Diagnostics) -> None:
    """Report ends of the image that are not local, and a topic that has only publishers or only subscriptions."""
    for end in ends:
        report_not_local(topic, end.endpoint, local.endpoint, diagnostics)
    for publishes, missing in ((True, "publishes"), (False, "subscribes to")):
        if not any(end.publishes == publishes for end in ends):
            report_missing(topic, missing, local.endpoint, diagnostics)


def _line(endpoint: EndpointDecl) -> str:
    """Return ` in line 12`, or nothing where there is no place."""
    return f" in line {endpoint.span.line}" if endpoint.span else ""


def report_not_local(name: str, end: EndpointDecl, local: EndpointDecl, diagnostics: Diagnostics) -> None:
    """Report an end that is not local, although the end `local` is."""
    if end.local == "never":
        diagnostics.error(
            f"the {end.kind} of '{name}' is not local, the {local.kind}{_line(local)} is",
            end.span,
            "Write `local:` at both, or at neither",
            id="MG-7170",
        )


def report_missing(name: str, missing: str, local: EndpointDecl, diagnostics: Diagnostics) -> None:
    """Report a name with only one kind of ends: nothing `missing` it, for example `publishes`."""
    diagnostics.error(
        f"`local: {local.local}` needs two ends: nothing in the image {missing} '{name}'",
        local.span,
        "Remove `local`, or declare the other end",
        id="MG-7171",
    )


def report_limits(name: str, end: EndpointDecl, other: EndpointDecl, diagnostics: Diagnostics) -> None:
    """Report an end whose limits are not those of the other one."""
    diagnostics.error(
        f"the limits of '{name}' differ from those of the {other.kind}{_line(other)}",
        end.span,
        "Write the same `limits:` at both, or by the type",
        id="MG-7175",
    )


def _check_qos(topic: str, end: End, diagnostics: Diagnostics) -> None:
    """Report QoS that local delivery does not have."""
    qos, span = end.endpoint.qos, end.endpoint.qos.span or end.endpoint.span
    found = [
        (qos.history == "keep_all", "`history: keep_all`"),
        (qos.durability == "transient_local", "`durability: transient_local`"),
        (bool(qos.deadline_ms), "a deadline"),
        (bool(qos.lifespan_ms), "a lifespan"),
    ]
    for wrong, what in found:
        if wrong:
            diagnostics.error(
                f"local delivery has no such QoS: '{topic}' has {what}",
                span,
                "Remove it, or remove `local`",
                id="MG-7172",
            )
    slots = end.endpoint.queue or qos.depth
    if not end.publishes and slots > MOST_SLOTS:
        diagnostics.error(
            f"{slots} local messages of '{topic}' are more than the {MOST_SLOTS} of a queue",
            span,
            f"Set queue: {MOST_SLOTS} or less",
            id="MG-7176",
        )


def _check_pairs(
    topic: str, ends: list[End], types: Mapping[TypeName, TypePlan], diagnostics: Diagnostics
) -> None:
    """Report each subscription that does not match a publisher, or would get its messages twice."""
    for reader in (end for end in ends if not end.publishes):
        span = reader.endpoint.span
        for writer in (end for end in ends if end.publishes):
            place = _line(writer.endpoint)
            if reader.endpoint.local == writer.endpoint.local == "also":
                diagnostics.error(
                    f"the messages of '{topic}' would arrive twice: the publisher{place} sends them to ROS, "
                    "where this subscription gets them, too",
                    span,
                    "Write `local: only` at the subscription or at the publisher",
                    id="MG-7173",
                )
            if (
                reader.endpoint.qos.reliability == "reliable"
                and writer.endpoint.qos.reliability != "reliable"
            ):
                diagnostics.error(
                    f"the subscription of '{topic}' is reliable and never matches the best effort publisher"
                    f"{place}",
                    reader.endpoint.qos.span or span,
                    "Write `qos: {reliability: best_effort}` at the subscription",
                    id="MG-7174",
                )
            if reader.limits(types) != writer.limits(types):
                report_limits(topic, reader.endpoint, writer.endpoint, diagnostics)
