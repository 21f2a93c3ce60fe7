# SPDX-License-Identifier: Apache-2.0
"""Which endpoints of an image do not exist at an agent, and whether none does."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.kinds import KINDS
from microros_gen.application.model import Application
from microros_gen.client.plan.declared import declarations, full_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass


@dataclass(frozen=True)
class AgentlessPlace:
    """A place of the client, in their order: whether it has no objects at the agent, as C writes it."""

    name: str
    value: str


@dataclass(frozen=True)
class AgentlessPlan:
    """`alone`: 1 where nothing of the image exists at an agent, else 0."""

    places: tuple[AgentlessPlace, ...]
    alone: int


def plan(context: PlanContext, diagnostics: Diagnostics) -> AgentlessPlan:
    """Return the places; endpoints that `entities: preconfigured` creates all the same are reported."""
    _check_created(context, diagnostics)
    alone = is_alone(context.application)
    return AgentlessPlan(tuple(_places(context, alone)), int(alone))


def record(part: AgentlessPlan) -> object:
    """Return what the plan id is made of."""
    return {
        "places": "".join("1" if place.value == "true" else "0" for place in part.places),
        "alone": part.alone,
    }


def is_alone(application: Application) -> bool:
    """Return whether nothing of an application exists at an agent."""
    return bool(application.nodes) and not any(
        endpoint.exists_at_agent for node in application.nodes for endpoint in node.endpoints
    )


def in_c(value: bool) -> str:
    """Return a truth value as C writes it."""
    return "true" if value else "false"


def _places(context: PlanContext, alone: bool) -> Iterator[AgentlessPlace]:
    """Yield the places in the order of the client: nodes, then publishers, subscriptions and what else there is."""
    entities = context.runtime.entities
    names = [node.full_name for node in context.application.nodes]
    yield from (AgentlessPlace(name, in_c(alone)) for name in names)
    yield from (AgentlessPlace("none", "false") for _ in range(entities.node_places - len(names)))
    for kind in KINDS:
        declared = declarations(context.application, kind.name)
        for _, node, endpoint in declared:
            name = f"{kind.name} {full_name(node, endpoint)}"
            yield AgentlessPlace(name, in_c(not endpoint.exists_at_agent))
        count = entities.publisher_places if kind is KINDS[0] else entities.places(kind.name).max
        yield from (AgentlessPlace("none", "false") for _ in range(count - len(declared)))


def _check_created(context: PlanContext, diagnostics: Diagnostics) -> None:
    if context.selection.entities != "preconfigured":
        return
    for kind in KINDS:
        for _, node, endpoint in declarations(context.application, kind.name):
            if not endpoint.exists_at_agent:
                name = full_name(node, endpoint)
                diagnostics.error(
                    f"'entities: preconfigured' creates the {endpoint.kind} of '{name}' at the agent",
                    endpoint.span,
                    "Write `also` instead of `only`, or use other `entities`",
                    id="MG-7177",
                )
