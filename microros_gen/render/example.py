# SPDX-License-Identifier: Apache-2.0
"""Prepared view of the example application."""

from __future__ import annotations

from dataclasses import dataclass

from microros_gen.model.types import TypeName
from microros_gen.plan.example import MemberValue, plan_filling
from microros_gen.plan.project import Project
from microros_gen.plan.types import TypePlan
from microros_gen.plan.types_names import include_path, snake_case


@dataclass(frozen=True)
class NodeView:
    """A node of the example."""

    variable: str
    name: str
    namespace: str


@dataclass(frozen=True)
class PublisherView:
    """A publisher of the example, with its message."""

    variable: str
    node: str
    message: str
    function: str
    init: str
    package: str
    type: str
    c_type: str
    topic: str
    storage: bool
    stamps: tuple[str, ...]
    values: tuple[MemberValue, ...]
    texts: tuple[MemberValue, ...]
    uses_count: bool


@dataclass(frozen=True)
class ExampleView:
    """The whole example."""

    title: str
    summary: str
    includes: tuple[str, ...]
    nodes: tuple[NodeView, ...]
    publishers: tuple[PublisherView, ...]
    uses_time: bool
    hosted: bool


def example_view(project: Project) -> ExampleView:
    """Return what examples/<profile>/main.c prints."""
    types = {plan.name: plan for plan in project.types}
    nodes = _nodes(project)
    publishers = tuple(_publishers(project, types, nodes))
    used = sorted({p.type_name for p in publishers})
    includes = {include_path(types[name].files.header) for name in used}
    includes |= {include_path(types[name].files.storage) for name in used if types[name].storage}
    views = tuple(p.view for p in publishers)
    if any(view.texts for view in views):
        includes.add("rosidl_runtime_c/string_functions.h")
    return ExampleView(
        title=project.name,
        summary=", ".join(f"{p.view.package}/msg/{p.view.type} on {p.view.topic}" for p in publishers)
        or "nothing",
        includes=tuple(sorted(includes)),
        nodes=nodes,
        publishers=views,
        uses_time=any(view.stamps for view in views),
        hosted=project.target.hosted,
    )


@dataclass(frozen=True)
class _Publisher:
    type_name: TypeName
    view: PublisherView


def _nodes(project: Project) -> tuple[NodeView, ...]:
    if project.runtime.nodes:
        return tuple(
            NodeView(f"node_{n.index}" if n.index else "node", n.name, _namespace(n.namespace))
            for n in project.runtime.nodes
        )
    return (NodeView("node", project.name.replace("+", "_"), ""),) if project.runtime.nodes_max else ()


def _publishers(
    project: Project, types: dict[TypeName, TypePlan], nodes: tuple[NodeView, ...]
) -> list[_Publisher]:
    runtime = project.runtime
    if runtime.nodes:
        return [
            _publisher(project, types[p.type], nodes[p.node], p.index, _topic(project, p.index), p.reliable)
            for p in runtime.publishers
        ]
    roots = project.roots[: runtime.publishers_max] if project.selection.has("publish") else ()
    topics = [snake_case(root.name) for root in roots]
    return [
        _publisher(
            project,
            types[root],
            nodes[0],
            index,
            topic if topics.count(topic) == 1 else f"{root.package}/{topic}",
            True,
        )
        for index, (root, topic) in enumerate(zip(roots, topics, strict=True))
    ]


def _topic(project: Project, index: int) -> str:
    declared = [e.topic for n in project.application.nodes for e in n.endpoints if e.kind == "publisher"]
    return declared[index]


def _publisher(
    project: Project, plan: TypePlan, node: NodeView, index: int, topic: str, reliable: bool
) -> _Publisher:
    messages = {p.name: p.message for p in project.types}
    filling = plan_filling(plan.message, messages, node.name)
    name = f"{snake_case(plan.name.name)}_{index}"
    view = PublisherView(
        variable=f"publisher_{index}",
        node=node.variable,
        message=name,
        function=f"publish_{name}",
        init="rclc_publisher_init_default" if reliable else "rclc_publisher_init_best_effort",
        package=plan.name.package,
        type=plan.name.name,
        c_type=plan.c_name,
        topic=topic,
        storage=bool(plan.storage),
        stamps=filling.stamps,
        values=filling.values,
        texts=filling.texts if plan.storage else (),
        uses_count=any("count" in v.value for v in filling.values),
    )
    return _Publisher(plan.name, view)


def _namespace(namespace: str) -> str:
    return "" if namespace == "/" else namespace
