# SPDX-License-Identifier: Apache-2.0
"""What the agent must hold: the entities that a client names (`reference`) or never speaks of (`preconfigured`)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from microros_gen.application.model import Application, EndpointDecl, Qos
from microros_gen.client.plan.creation import (
    participant_reference,
    reader_reference,
    replier_reference,
    requester_reference,
    topic_reference,
    writer_reference,
)
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.example import example_node, example_topics
from microros_gen.client.plan.project import Project
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.dds_names import dds_topic, dds_type, reply_topic, request_topic
from microros_gen.records import dataclass
from microros_gen.selection.model import Selection

REFERENCES = "agent/references.xml"
ENTITIES = "agent/entities.json"
_KINDS = {
    "participant": 1,
    "topic": 2,
    "publisher": 3,
    "subscriber": 4,
    "data_writer": 5,
    "data_reader": 6,
    "requester": 7,
    "replier": 8,
}
_REFERENCES = {"publisher": writer_reference, "subscription": reader_reference}


@dataclass(frozen=True)
class AgentNode:
    """A participant; `name` is what it carries."""

    index: int
    name: str
    domain_id: int
    reference: str


@dataclass(frozen=True)
class AgentEndpoint:
    """A topic with its publisher and data writer, or (`reads`) its subscriber and data reader.

    `qos` holds what XRCE carries, nothing is left to a default. `index` is that of its objects.
    """

    index: int
    node: int
    topic: str
    dds_type: str
    qos: Qos
    topic_reference: str
    reference: str
    reads: bool = False

    @property
    def group(self) -> str:
        """The kind of the object between participant and data writer or reader."""
        return "subscriber" if self.reads else "publisher"

    @property
    def kind(self) -> str:
        """The kind of the object that the client writes or reads."""
        return "data_reader" if self.reads else "data_writer"


@dataclass(frozen=True)
class AgentService:
    """A replier or (`calls`) a requester. `name` is the service's; the types are those of its messages in DDS."""

    index: int
    node: int
    name: str
    dds_type: str
    calls: bool

    @property
    def kind(self) -> str:
        """The kind of its object."""
        return "requester" if self.calls else "replier"

    @property
    def reference(self) -> str:
        """The name under which the client asks for it."""
        return requester_reference(self.name) if self.calls else replier_reference(self.name)

    @property
    def types(self) -> tuple[str, str]:
        """The types of requests and replies."""
        return f"{self.dds_type}Request_", f"{self.dds_type}Response_"

    @property
    def topics(self) -> tuple[str, str]:
        """The topics of requests and replies."""
        return request_topic(self.name), reply_topic(self.name)


@dataclass(frozen=True)
class AgentFiles:
    """The files' contents. `key` is the client's, None: any. `complete` is false where others may be created too.

    `adopt`: the client never opens its session again (no liveliness), so an agent that restarts has to know it.
    """

    key: int | None
    nodes: tuple[AgentNode, ...]
    endpoints: tuple[AgentEndpoint, ...]
    complete: bool
    adopt: bool = False
    services: tuple[AgentService, ...] = ()


def object_id(index: int, kind: str) -> int:
    """Return the id of an object of the C client: twelve bits of its place, four of its kind."""
    return index << 4 | _KINDS[kind]


def plan_agent_files(project: Project) -> AgentFiles:
    """Return what the agent must hold. Without `nodes:` it is what the example creates."""
    runtime = project.runtime
    if not runtime.entities.declared:
        nodes, found = _of_the_example(project)
        named = tuple(_services_of_the_example(project))
        return AgentFiles(runtime.session.client_key, nodes, found, complete=False, services=named)
    written = [endpoint.qos for _, _, endpoint in declarations(project.application, "publisher")]
    read = [endpoint.qos for _, _, endpoint in declarations(project.application, "subscription")]
    nodes = tuple(
        AgentNode(
            n.index,
            n.participant_name,
            n.domain_id,
            participant_reference(n.participant_name, len(runtime.entities.nodes.declared)),
        )
        for n in runtime.entities.nodes.declared
    )
    endpoints = [
        _endpoint(p.index, p.node, p.topic, p.dds_type, written[p.index])
        for p in runtime.entities.publishers.declared
    ]
    endpoints += [
        _endpoint(
            runtime.entities.publisher_places + s.index,
            s.node,
            s.topic,
            s.dds_type,
            read[s.index],
            reads=True,
        )
        for s in runtime.entities.subscriptions.declared
    ]
    adopt = project.selection.liveliness == "none" and runtime.session.client_key is not None
    services = tuple(_services(runtime))
    return AgentFiles(
        runtime.session.client_key, nodes, tuple(endpoints), complete=True, adopt=adopt, services=services
    )


def _services(runtime: RuntimePlan) -> Iterator[AgentService]:
    first = runtime.entities.publisher_places + runtime.entities.subscriptions.max
    for service in runtime.entities.services.declared:
        yield AgentService(first + service.index, service.node, service.name, service.dds_type, calls=False)
    for client in runtime.entities.clients.declared:
        index = first + runtime.entities.services.max + client.index
        yield AgentService(index, client.node, client.name, client.dds_type, calls=True)


def check_entities(application: Application, selection: Selection, diagnostics: Diagnostics) -> None:
    """Report what the way to create entities cannot have: entities that nobody declares, one name for two."""
    if selection.entities == "preconfigured" and not application.nodes:
        chosen = next(axis for axis in selection.axes if axis.axis == "entities")
        diagnostics.error(
            f"entities: preconfigured ({chosen.reason}) needs `nodes:`: the agent creates what is declared there",
            application.entities.span if application.entities else application.spans.get("interfaces"),
            "Declare the nodes and their endpoints, or write `entities: reference`",
            id="MG-7001",
        )
    if selection.entities == "reference":
        _check_references(application, diagnostics)


def _check_references(application: Application, diagnostics: Diagnostics) -> None:
    """One reference is one description: endpoints of one topic share it, so they must not differ."""
    first: dict[tuple[str, str], EndpointDecl] = {}
    for _, node, endpoint in declarations(application, *_REFERENCES):
        topic = full_name(node, endpoint)
        on_topic = first.setdefault(("", topic), endpoint)
        alike = first.setdefault((endpoint.kind, topic), endpoint)
        if (alike.type, _carried(alike.qos)) != (endpoint.type, _carried(endpoint.qos)):
            what, other, reference = f"{endpoint.kind}s", alike, _REFERENCES[endpoint.kind](topic)
        elif on_topic.type != endpoint.type:
            what, other, reference = "endpoints", on_topic, topic_reference(topic)
        else:
            continue
        diagnostics.error(
            f"two {what} of {topic} differ in type or QoS and would get the same reference name, "
            f"'{reference}' (the other: {other.span or other.topic})",
            endpoint.topic_span or endpoint.span,
            "Make them alike, or write `entities: binary`",
            id="MG-7002",
        )


def _of_the_example(project: Project) -> tuple[tuple[AgentNode, ...], tuple[AgentEndpoint, ...]]:
    runtime = project.runtime
    name = example_node(project.name)
    node = AgentNode(0, name, 0, participant_reference(name, runtime.entities.nodes.max))
    written = runtime.entities.publishers.max if project.selection.has("publish") else 0
    endpoints = [
        _endpoint(index, 0, f"/{topic}", dds_type(root), Qos())
        for index, (root, topic) in enumerate(example_topics(project.roots[:written]))
    ]
    first = runtime.entities.publisher_places
    endpoints += [
        _endpoint(index, 0, e.topic, dds_type(type_name(e.type)), e.qos, reads=True)
        for index, e in enumerate(project.application.implied, first)
    ]
    endpoints += [
        _endpoint(index, 0, f"/{topic}", dds_type(root), Qos(), reads=True)
        for index, (root, topic) in enumerate(
            example_topics(project.roots[: runtime.entities.subscriptions.application]),
            first + len(project.application.implied),
        )
    ]
    return (node,), tuple(endpoints)


def _services_of_the_example(project: Project) -> Iterator[AgentService]:
    runtime = project.runtime
    places = runtime.entities.publisher_places + runtime.entities.subscriptions.max
    for most, first, calls in (
        (runtime.entities.services.max, places, False),
        (runtime.entities.clients.max, places + runtime.entities.services.max, True),
    ):
        for index, (service, name) in enumerate(example_topics(project.services[:most]), first):
            yield AgentService(index, 0, f"/{name}", dds_type(service), calls)


def _endpoint(
    index: int, node: int, topic: str, type_: str, qos: Qos, *, reads: bool = False
) -> AgentEndpoint:
    reference = reader_reference(topic) if reads else writer_reference(topic)
    return AgentEndpoint(
        index, node, dds_topic(topic), type_, _carried(qos), topic_reference(topic), reference, reads
    )


def _carried(qos: Qos) -> Qos:
    """Return `qos` as rmw_qos_to_xrce reads it: the system's defaults are replaced by their values."""
    return replace(
        qos,
        reliability="best_effort" if qos.reliability == "best_effort" else "reliable",
        durability="transient_local" if qos.durability == "transient_local" else "volatile",
        history="keep_all" if qos.history == "keep_all" else "keep_last",
        span=None,
    )
