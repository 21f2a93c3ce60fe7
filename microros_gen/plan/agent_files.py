# SPDX-License-Identifier: Apache-2.0
"""What the agent must hold: the entities that a client names (`reference`) or never speaks of (`preconfigured`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from microros_gen.diagnostics import Diagnostics
from microros_gen.model.application import Application, EndpointDecl, Qos
from microros_gen.model.names import expand_topic_name
from microros_gen.model.selection import Selection
from microros_gen.plan.creation import participant_reference, topic_reference, writer_reference
from microros_gen.plan.example import example_node, example_topics
from microros_gen.plan.names import dds_topic, dds_type
from microros_gen.plan.project import Project, publisher_declarations

REFERENCES = "agent/references.xml"
ENTITIES = "agent/entities.json"
_KINDS = {"participant": 1, "topic": 2, "publisher": 3, "data_writer": 5}


@dataclass(frozen=True)
class AgentNode:
    """A participant; `name` is what it carries."""

    index: int
    name: str
    domain_id: int
    reference: str


@dataclass(frozen=True)
class AgentWriter:
    """A topic, its publisher and its data writer. `qos` holds what XRCE carries, nothing is left to a default."""

    index: int
    node: int
    topic: str
    dds_type: str
    qos: Qos
    topic_reference: str
    writer_reference: str


@dataclass(frozen=True)
class AgentFiles:
    """The files' contents. `key` is the client's, None: any. `complete` is false where others may be created too.

    `adopt`: the client never opens its session again (no liveliness), so an agent that restarts has to know it.
    """

    key: int | None
    nodes: tuple[AgentNode, ...]
    writers: tuple[AgentWriter, ...]
    complete: bool
    adopt: bool = False


def object_id(index: int, kind: str) -> int:
    """Return the id of an object of the C client: twelve bits of its place, four of its kind."""
    return index << 4 | _KINDS[kind]


def plan_agent_files(project: Project) -> AgentFiles:
    """Return what the agent must hold. Without `nodes:` it is what the example creates."""
    runtime = project.runtime
    if not runtime.declared:
        return AgentFiles(runtime.client_key, *_of_the_example(project), complete=False)
    declared = [endpoint for _, _, endpoint in publisher_declarations(project.application)]
    nodes = tuple(
        AgentNode(
            n.index,
            n.participant_name,
            n.domain_id,
            participant_reference(n.participant_name, len(runtime.nodes)),
        )
        for n in runtime.nodes
    )
    writers = tuple(
        _writer(p.index, p.node, p.topic, p.dds_type, declared[p.index].qos) for p in runtime.publishers
    )
    adopt = project.selection.liveliness == "none" and runtime.client_key is not None
    return AgentFiles(runtime.client_key, nodes, writers, complete=True, adopt=adopt)


def check_entities(application: Application, selection: Selection, diagnostics: Diagnostics) -> None:
    """Report what the way to create entities cannot have: entities that nobody declares, one name for two."""
    if selection.entities == "preconfigured" and not application.nodes:
        chosen = next(axis for axis in selection.axes if axis.axis == "entities")
        diagnostics.error(
            f"entities: preconfigured ({chosen.reason}) needs `nodes:`: the agent makes what is declared there",
            application.entities.span if application.entities else application.spans.get("interfaces"),
            "Declare the nodes and their publishers, or write `entities: reference`",
        )
    if selection.entities == "reference":
        _check_references(application, diagnostics)


def _check_references(application: Application, diagnostics: Diagnostics) -> None:
    """One reference is one description: publishers of one topic share it, so they must not differ."""
    first: dict[str, EndpointDecl] = {}
    for _, node, endpoint in publisher_declarations(application):
        topic = expand_topic_name(endpoint.topic, node.name, node.namespace)
        other = first.setdefault(topic, endpoint)
        same = (other.type, _carried(other.qos)) == (endpoint.type, _carried(endpoint.qos))
        if not same:
            diagnostics.error(
                f"two publishers of {topic} differ in type or QoS and would get one reference name, "
                f"'{writer_reference(topic)}' (the other: {other.span})",
                endpoint.topic_span or endpoint.span,
                "Make them alike, or write `entities: binary`",
            )


def _of_the_example(project: Project) -> tuple[tuple[AgentNode, ...], tuple[AgentWriter, ...]]:
    runtime = project.runtime
    name = example_node(project.name)
    node = AgentNode(0, name, 0, participant_reference(name, runtime.nodes_max))
    topics: Mapping[str, str] = {
        f"/{topic}": dds_type(root) for root, topic in example_topics(project.roots[: runtime.publishers_max])
    }
    writers = tuple(_writer(i, 0, topic, topics[topic], Qos()) for i, topic in enumerate(topics))
    return (node,), writers if project.selection.has("publish") else ()


def _writer(index: int, node: int, topic: str, type_: str, qos: Qos) -> AgentWriter:
    references = topic_reference(topic), writer_reference(topic)
    return AgentWriter(index, node, dds_topic(topic), type_, _carried(qos), *references)


def _carried(qos: Qos) -> Qos:
    """Return `qos` as rmw_qos_to_xrce reads it: what is left to the system becomes what it stands for."""
    return replace(
        qos,
        reliability="best_effort" if qos.reliability == "best_effort" else "reliable",
        durability="transient_local" if qos.durability == "transient_local" else "volatile",
        history="keep_all" if qos.history == "keep_all" else "keep_last",
        span=None,
    )
