# SPDX-License-Identifier: Apache-2.0
"""Prepared view of the services and clients of the example application."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from microros_gen.client.plan.declared import declarations
from microros_gen.client.plan.example import Filling, example_topics, plan_filling, plan_shown
from microros_gen.client.plan.project import Project
from microros_gen.interfaces.derived import derived_name
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import include_path, snake_case
from microros_gen.typesupport.plan.types import TypePlan


@dataclass(frozen=True)
class MessageView:
    """A request or a response of the example; `storage` is empty where it needs none."""

    variable: str
    c_type: str
    storage: str


@dataclass(frozen=True)
class ServiceView:
    """A service server or client of the example, by `kind`.

    `function` is called for what comes to a server, or sends a request; `reply_function` for what comes to a client.
    `sent` is filled as `filling` says; of `received` the first member that can be printed is `format` and `value`, both
    empty where it has none.
    """

    kind: str
    variable: str
    node: str
    node_index: int
    function: str
    reply_function: str
    package: str
    type: str
    name: str
    sent: MessageView
    received: MessageView
    filling: Filling
    uses_count: bool
    format: str
    value: str
    includes: tuple[str, ...]


def service_views(project: Project, nodes: tuple[str, ...]) -> tuple[ServiceView, ...]:
    """Return servers, then clients. `nodes` are the variables of the nodes."""
    types = {plan.name: plan for plan in project.types}
    runtime = project.runtime
    if not runtime.entities.declared:
        named = example_topics(project.services)
        places = (("service", runtime.entities.services.max), ("client", runtime.entities.clients.max))
        return tuple(
            _view(project, types, kind, index, (nodes[0], 0), topic, service, topic)
            for kind, most in places
            for index, (service, topic) in enumerate(named[:most])
        )
    views: list[ServiceView] = []
    for kind, planned in (
        ("service", runtime.entities.services.declared),
        ("client", runtime.entities.clients.declared),
    ):
        declared = [endpoint for _, _, endpoint in declarations(project.application, kind)]
        views += [
            _view(
                project,
                types,
                kind,
                s.index,
                (nodes[s.node], s.node),
                declared[s.index].declared_as or declared[s.index].topic,
                s.type,
                s.name,
            )
            for s in planned
            if not declared[s.index].of_the_library
        ]
    return tuple(views)


def _view(
    project: Project,
    types: Mapping[TypeName, TypePlan],
    kind: str,
    index: int,
    node: tuple[str, int],
    written: str,
    service: TypeName,
    full: str,
) -> ServiceView:
    """`written` is the name as the application has it, `full` the expanded one."""
    is_server = kind == "service"
    plans = {part: types[derived_name(service, part)] for part in ("Request", "Response")}
    own = f"{snake_case(service.name)}_{index}"
    prefix = "" if is_server else "asked_"
    messages = {
        part: MessageView(
            f"{prefix}{own}_{part.lower()}", plan.c_name, plan.storage_name(full) if plan.storage else ""
        )
        for part, plan in plans.items()
    }
    sent, received = ("Response", "Request") if is_server else ("Request", "Response")
    limits = plans[sent].limit_set(kind, index)
    filling = plan_filling(
        plans[sent].message, project.messages, "text", limits.limits if limits else plans[sent].limits
    )
    if not plans[sent].storage:
        filling = Filling(filling.stamps, filling.values, ())
    shown = plan_shown(plans[received].message, project.messages)
    return ServiceView(
        kind=kind,
        variable=f"{kind}_{index}",
        node=node[0],
        node_index=node[1],
        function=f"{'serve' if is_server else 'ask'}_{own}",
        reply_function="" if is_server else f"on_reply_of_{own}",
        package=service.package,
        type=service.name,
        name=written,
        sent=messages[sent],
        received=messages[received],
        filling=filling,
        uses_count=any("count" in v.value for v in filling.values),
        format=shown.format if shown else "",
        value=shown.expression.format(message=messages[received].variable) if shown else "",
        includes=tuple(_includes(plans)),
    )


def _includes(plans: Mapping[str, TypePlan]) -> Iterator[str]:
    for plan in plans.values():
        yield include_path(plan.files.header)
        if plan.storage:
            yield include_path(plan.files.storage)
