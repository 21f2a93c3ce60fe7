# SPDX-License-Identifier: Apache-2.0
"""What a component plans for itself: the module `plan.py` of its folder, where it has one.

Only components that ship with the tool have one; nothing from outside is imported.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from importlib import import_module
from typing import Any, Protocol, cast

from microros_gen.application.limit_tree import limit_text, tree_of_rules
from microros_gen.application.model import Application, EndpointDecl, LimitRule, NodeDecl
from microros_gen.client.plan.feature_slices import NO_FEATURES, Features, FeatureSlice
from microros_gen.client.plan.line_load import LineLoad
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.files import is_file
from microros_gen.interfaces.types import TypeName
from microros_gen.platform.target import Target
from microros_gen.records import dataclass
from microros_gen.selection.component import Component
from microros_gen.selection.model import Selection
from microros_gen.typesupport.plan.types import TypePlan

PLAN_FILE = "plan.py"


@dataclass(frozen=True)
class PlanContext:
    """The input of a component's plan; `runtime` is the plan without the slices of components.

    `line`: what the publishers with a rate need of the line to the agent.
    """

    application: Application
    selection: Selection
    target: Target
    types: Mapping[TypeName, TypePlan]
    runtime: RuntimePlan
    line: LineLoad | None = None


class Feature(Protocol):
    """The functions of a component's plan.py; one that has no `limits` implies none."""

    def plan(self, context: PlanContext, diagnostics: Diagnostics) -> object:
        """Return the component's slice, a frozen data class; what is wrong goes to `diagnostics`."""

    def record(self, part: Any) -> object:
        """Return what of its slice changes the library's layout or behavior, as plain data with its own keys."""


class Limiting(Protocol):
    """What a plan.py has as well, where endpoints that the component implies have limits."""

    def limits(self, application: Application) -> tuple[LimitRule, ...]:
        """Return rules for what they exchange, without those that the application has itself."""


class Opening(Protocol):
    """What a plan.py has as well, where the component opens endpoints that the application file describes otherwise."""

    def endpoints(self, node: NodeDecl) -> Iterable[EndpointDecl]:
        """Return the endpoints of a node."""


def with_endpoints(application: Application, selection: Selection) -> Application:
    """Return the application with the endpoints that selected components plan, before those that each node declares.

    They follow what components imply: /clock has the first place of all subscriptions.
    """
    opening = [cast(Opening, feature) for feature in _features(selection) if hasattr(feature, "endpoints")]
    if not opening:
        return application
    nodes = (
        replace(node, endpoints=_joined(node, [e for part in opening for e in part.endpoints(node)]))
        for node in application.nodes
    )
    return replace(application, nodes=tuple(nodes))


def _joined(node: NodeDecl, planned: Iterable[EndpointDecl]) -> tuple[EndpointDecl, ...]:
    implied = next((i for i, e in enumerate(node.endpoints) if not e.of_the_library), len(node.endpoints))
    return (*node.endpoints[:implied], *planned, *node.endpoints[implied:])


def with_limits(application: Application, selection: Selection) -> Application:
    """Return the application with the limits of what selected components exchange, after its own.

    Where several limit the same, the largest holds.
    """
    rules: dict[tuple[str, ...], LimitRule] = {}
    for feature in _features(selection):
        if hasattr(feature, "limits"):
            for rule in cast(Limiting, feature).limits(application):
                rules[rule.path] = _larger(rules.get(rule.path), rule)
    return replace(application, limits=(*application.limits, *rules.values())) if rules else application


def _larger(first: LimitRule | None, second: LimitRule) -> LimitRule:
    if first is None:
        return second
    strings = [rule.string for rule in (first, second) if rule.string is not None]
    sequences = [rule.sequence for rule in (first, second) if rule.sequence is not None]
    return replace(first, string=max(strings, default=None), sequence=max(sequences, default=None))


def _features(selection: Selection) -> Iterator[Feature]:
    """Yield the plan.py of each selected component that has one."""
    for chosen in selection.components:
        feature = feature_of(chosen.component)
        if feature is not None:
            yield feature


def plan_features(context: PlanContext, diagnostics: Diagnostics) -> Features:
    """Return the slices of all selected components that plan something for themselves, in their order.

    A plan.py with READS_SLICES is planned after the others, whose slices `context.runtime.features` has then.
    """
    found = {c.component.name: feature_of(c.component) for c in context.selection.components}
    features = {name: feature for name, feature in found.items() if feature is not None}
    slices: dict[str, FeatureSlice] = {}
    for name, feature in sorted(features.items(), key=lambda item: hasattr(item[1], "READS_SLICES")):
        known = context
        if hasattr(feature, "READS_SLICES"):
            known = replace(
                context, runtime=replace(context.runtime, features=Features(tuple(slices.values())))
            )
        part = feature.plan(known, diagnostics)
        record = json.dumps(feature.record(part), sort_keys=True, separators=(",", ":"))
        slices[name] = FeatureSlice(name, part, record)
    return Features(tuple(slices[name] for name in features)) if slices else NO_FEATURES


def feature_of(component: Component) -> Feature | None:
    """Return the plan.py of a component; None: it has none, or does not ship with the tool."""
    if component.origin or component.layer == "port" or not is_file(component.folder / PLAN_FILE):
        return None
    return cast(Feature, import_module(f"microros_gen.components.{component.name}.plan"))


def refuse_short_doubles(context: PlanContext, name: str, diagnostics: Diagnostics) -> None:
    """Report a component whose values of type double are those of messages, where a double has 4 bytes."""
    if context.target.is_narrow:
        spans = context.application.spans
        diagnostics.error(
            f"the component '{name}' needs a double of 8 bytes; '{context.target.name}' has one of 4",
            spans.get("target") or spans.get("components") or spans.get("profiles"),
            "Use a target with 32 bits, or leave out the parameters",
            id="MG-5015",
        )


def refuse_own_limits(context: PlanContext, name: str, diagnostics: Diagnostics) -> None:
    """Report limits of an endpoint that this component opens, where it is compiled for those of the type."""
    own = {
        i.name: i.type
        for c in context.selection.components
        if c.component.name == name
        for i in c.component.implies
    }
    for endpoint in (e for e in context.application.endpoints if e.limits and e.name in own):
        diagnostics.error(
            f"the limits of '{endpoint.name}' cannot differ from those of its type",
            endpoint.span,
            f"Remove them, and write `limits: {_limits_by_type(own[endpoint.name], endpoint.limits)}`",
            id="MG-7033",
        )


def _limits_by_type(name: str, limits: Iterable[LimitRule]) -> str:
    """Return an endpoint's own limits as the application's; those of a service are for its request."""
    owner = name if "/msg/" in name else f"{name}_Request"
    return limit_text({owner: tree_of_rules(limits)})
