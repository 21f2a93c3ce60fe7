# SPDX-License-Identifier: Apache-2.0
"""Prepared view of the example application."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from microros_gen.application.model import EndpointDecl, Qos
from microros_gen.client.plan.declared import declarations
from microros_gen.client.plan.example import (
    MemberValue,
    example_node,
    example_topics,
    plan_filling,
    plan_shown,
)
from microros_gen.client.plan.project import Project
from microros_gen.client.views.example_running import Received, RunningView, Sender, running_view
from microros_gen.client.views.example_services import ServiceView, service_views
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import include_path, snake_case
from microros_gen.typesupport.plan.types import TypePlan


@dataclass(frozen=True)
class NodeView:
    """A node of the example."""

    variable: str
    name: str
    namespace: str


@dataclass(frozen=True)
class EndpointView:
    """A publisher or subscription of the example: its variable, its function, and its message with its storage."""

    variable: str
    node: str
    message: str
    function: str
    init: str
    qos: tuple[str, ...]
    package: str
    type: str
    c_type: str
    topic: str
    storage: str


@dataclass(frozen=True)
class PublisherView(EndpointView):
    """A publisher of the example, and what it fills its message with."""

    stamps: tuple[str, ...]
    values: tuple[MemberValue, ...]
    texts: tuple[MemberValue, ...]
    uses_count: bool
    elements: tuple[str, ...] = ()


@dataclass(frozen=True)
class SubscriptionView(EndpointView):
    """A subscription of the example, and the first thing in its message that can be printed.

    `format` is what printf takes for `value`, both empty where the message has no plain member.
    """

    format: str
    value: str
    received: Received


@dataclass(frozen=True)
class ExampleView:
    """The whole example; `heading` is what its comment says of it, `running` what an executor runs, if there is one."""

    title: str
    heading: str
    summary: str
    includes: tuple[str, ...]
    nodes: tuple[NodeView, ...]
    publishers: tuple[PublisherView, ...]
    subscriptions: tuple[SubscriptionView, ...]
    services: tuple[ServiceView, ...]
    puts_text: bool
    uses_time: bool
    hosted: bool
    ros_time: bool
    has_epoch: bool
    shows_time: bool
    running: RunningView | None
    needs_port: bool
    has_period: bool


def example_view(
    project: Project, headers: Sequence[str] = (), handles: int = 0, *, has_parts: bool = False
) -> ExampleView:
    """Return what examples/<profile>/main.c prints.

    Parts of components are printed with it (`has_parts`): they include `headers`, and the first executor has
    `handles` for them.
    """
    types = {plan.name: plan for plan in project.types}
    nodes = _nodes(project)
    publishers = tuple(_publishers(project, types, nodes))
    subscriptions = tuple(_subscriptions(project, types, nodes))
    used = sorted({p.type_name for p in publishers} | {name for name, _ in subscriptions})
    includes = {include_path(types[name].files.header) for name in used}
    includes |= {include_path(types[name].files.storage) for name in used if types[name].storage}
    views = tuple(p.view for p in publishers)
    services = service_views(project, tuple(node.variable for node in nodes))
    shows_time = project.runtime.clock.has_ros_time and not (
        has_parts or views or subscriptions or project.runtime.entities.serves or project.runtime.timers.any
    )
    running = None
    if not shows_time:
        running = running_view(
            project,
            [node.variable for node in nodes],
            [Sender(view.function, view.node, view.topic) for view in views],
            [view.received for _, view in subscriptions],
            services,
            handles,
        )
    includes |= set(headers)
    includes |= {include for service in services for include in service.includes}
    puts_text = any(view.texts for view in views) or any(service.filling.texts for service in services)
    if puts_text:
        includes.add("rosidl_runtime_c/string.h")
    uses_time = any(view.stamps for view in views) or any(s.filling.stamps for s in services)
    waits = running is not None and not running.timers
    has_tasks = running is not None and running.has_tasks
    has_period = running is None or waits or not project.runtime.timers.declared
    return ExampleView(
        title=project.name,
        heading=f"An application for {project.name}, to start from: copy it out of this folder and change it.",
        summary=_summary(views, [view for _, view in subscriptions], services, shows_time, running),
        includes=tuple(sorted(includes)),
        nodes=nodes,
        publishers=views,
        subscriptions=tuple(view for _, view in subscriptions),
        services=services,
        puts_text=puts_text,
        uses_time=uses_time,
        hosted=project.target.hosted,
        ros_time=project.runtime.clock.has_ros_time,
        has_epoch=project.target.hosted or project.runtime.session.has_time_sync,
        shows_time=shows_time,
        running=running,
        needs_port=(uses_time and not project.runtime.clock.has_ros_time) or waits or has_tasks,
        has_period=has_period,
    )


@dataclass(frozen=True)
class _Publisher:
    type_name: TypeName
    view: PublisherView


def _nodes(project: Project) -> tuple[NodeView, ...]:
    if project.runtime.entities.nodes.declared:
        return tuple(
            NodeView(f"node_{n.index}" if n.index else "node", n.source_name, _namespace(n.source_namespace))
            for n in project.runtime.entities.nodes.declared
        )
    has_node = project.runtime.entities.nodes.max and project.selection.has("node")
    return (NodeView("node", example_node(project.name), ""),) if has_node else ()


def _publishers(
    project: Project, types: dict[TypeName, TypePlan], nodes: tuple[NodeView, ...]
) -> list[_Publisher]:
    runtime = project.runtime
    if runtime.entities.nodes.declared:
        declared = [endpoint for _, _, endpoint in declarations(project.application, "publisher")]
        return [
            _publisher(
                project,
                types[p.type],
                nodes[p.node],
                p.index,
                declared[p.index].declared_as or declared[p.index].topic,
                declared[p.index].qos,
                types[p.type].storage_name(p.topic),
            )
            for p in runtime.entities.publishers.declared
            if not declared[p.index].of_the_library
        ]
    roots = project.roots[: runtime.entities.publishers.max] if project.selection.has("publish") else ()
    return [
        _publisher(project, types[root], nodes[0], index, topic, Qos(), types[root].c_name)
        for index, (root, topic) in enumerate(example_topics(roots))
    ]


def _summary(
    publishers: Sequence[PublisherView],
    subscriptions: Sequence[SubscriptionView],
    services: Sequence[ServiceView],
    shows_time: bool,
    running: RunningView | None,
) -> str:
    """Return what the example does, as a sentence without its end."""
    has_timers = running is not None and bool(running.timers)
    every = "with each call of its timers" if has_timers else "every EXAMPLE_PERIOD_MS milliseconds"
    if shows_time:
        return f"looks {every} what time it is on /clock"
    clauses = []
    if publishers or not (subscriptions or services):
        written = ", ".join(f"{p.package}/msg/{p.type} on {p.topic}" for p in publishers) or "nothing"
        clauses.append(f"publishes {written}" + ("" if subscriptions else f" {every}"))
    if subscriptions:
        read = ", ".join(f"{s.package}/msg/{s.type} on {s.topic}" for s in subscriptions)
        clauses.append(f"looks {every} for {read}" if running is None else f"has an executor take {read}")
    for kind, does in (("service", "answers what it is asked as"), ("client", f"asks {every}")):
        named = ", ".join(f"{s.name} ({s.package}/srv/{s.type})" for s in services if s.kind == kind)
        clauses += [f"{does} {named}"] if named else []
    return " and ".join(clauses)


def _subscriptions(
    project: Project, types: dict[TypeName, TypePlan], nodes: tuple[NodeView, ...]
) -> list[tuple[TypeName, SubscriptionView]]:
    runtime = project.runtime
    if runtime.entities.nodes.declared:
        declared = [endpoint for _, _, endpoint in declarations(project.application, "subscription")]
        return [
            (
                s.type,
                _subscription(project, types[s.type], nodes[s.node], s.index, declared[s.index], s.storage),
            )
            for s in runtime.entities.subscriptions.declared
            if not declared[s.index].of_the_library
        ]
    topics = example_topics(project.roots[: runtime.entities.subscriptions.application])
    return [
        (
            root,
            _subscription(
                project,
                types[root],
                nodes[0],
                index,
                EndpointDecl("subscription", topic, str(root)),
                types[root].c_name if types[root].storage else "",
            ),
        )
        for index, (root, topic) in enumerate(topics)
    ]


def _subscription(
    project: Project, plan: TypePlan, node: NodeView, index: int, endpoint: EndpointDecl, storage: str
) -> SubscriptionView:
    name = f"{snake_case(plan.name.name)}_received_{index}"
    init, changes = _init(endpoint.qos, "subscription")
    shown = plan_shown(plan.message, project.messages)
    return SubscriptionView(
        variable=f"subscription_{index}",
        node=node.variable,
        message=name,
        function=f"take_{name}",
        init=init,
        qos=changes,
        package=plan.name.package,
        type=plan.name.name,
        c_type=plan.c_name,
        topic=endpoint.declared_as or endpoint.topic,
        storage=storage,
        format=shown.format if shown else "",
        value=shown.expression.format(message=name) if shown else "",
        received=Received(
            variable=f"subscription_{index}",
            node=node.variable,
            topic=endpoint.declared_as or endpoint.topic,
            message=name,
            c_type=plan.c_name,
            callback=f"on_{name}",
            format=shown.format if shown else "",
            value=shown.expression.replace("{message}.", "received->") if shown else "",
        ),
    )


# rmw_qos_profile_sensor_data, as rclc_publisher_init_best_effort takes it.
_SENSOR_DATA = Qos(reliability="best_effort", depth=5)


def _init(qos: Qos, what: str = "publisher") -> tuple[str, tuple[str, ...]]:
    """Return the function that opens the publisher or subscription, and what differs from the default QoS, as C."""
    requested, default = replace(qos, span=None), Qos()
    if requested == default:
        return f"rclc_{what}_init_default", ()
    if requested == _SENSOR_DATA:
        return f"rclc_{what}_init_best_effort", ()
    policies = [(p, getattr(requested, p)) for p in ("reliability", "durability", "history")]
    changes = [
        f"{policy} = RMW_QOS_POLICY_{policy.upper()}_{value.upper()}"
        for policy, value in policies
        if value != getattr(default, policy)
    ]
    changes += [f"depth = {requested.depth}"] if requested.depth != default.depth else []
    changes += _times("deadline", requested.deadline_ms) + _times("lifespan", requested.lifespan_ms)
    return f"rclc_{what}_init", tuple(changes)


def _times(policy: str, milliseconds: int) -> list[str]:
    parts = (("sec", milliseconds // 1000), ("nsec", milliseconds % 1000 * 1_000_000))
    return [f"{policy}.{part} = {value}" for part, value in parts if value]


def _publisher(
    project: Project, plan: TypePlan, node: NodeView, index: int, topic: str, qos: Qos, storage: str
) -> _Publisher:
    own = plan.limit_set("publisher", index)
    filling = plan_filling(plan.message, project.messages, node.name, own.limits if own else plan.limits)
    name = f"{snake_case(plan.name.name)}_{index}"
    init, changes = _init(qos)
    view = PublisherView(
        variable=f"publisher_{index}",
        node=node.variable,
        message=name,
        function=f"publish_{name}",
        init=init,
        qos=changes,
        package=plan.name.package,
        type=plan.name.name,
        c_type=plan.c_name,
        topic=topic,
        storage=storage if plan.storage else "",
        stamps=filling.stamps,
        values=filling.values,
        texts=(*filling.texts, *filling.element_texts) if plan.storage else (),
        elements=filling.elements if plan.storage else (),
        uses_count=any("count" in v.value for v in filling.values),
    )
    return _Publisher(plan.name, view)


def _namespace(namespace: str) -> str:
    return "" if namespace == "/" else namespace
