# SPDX-License-Identifier: Apache-2.0
"""The whole plan: entities, streams, pools and names of one selection, as data."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property

from microros_gen.application.model import DISCOVERY_PORT, Application, EndpointDecl, NodeDecl, Transport
from microros_gen.application.names import expand_topic_name
from microros_gen.client.plan.board import RING_CHUNK, BoardPlan, has_own_line, plan_board
from microros_gen.client.plan.creation import CreateNames, create_size, create_text, participant_reference
from microros_gen.client.plan.declared import (
    declarations,
    implied,
    named_at,
    pool,
    timed_qos,
    type_name,
)
from microros_gen.client.plan.entities import EntitiesPlan, Places
from microros_gen.client.plan.plan_id import plan_id
from microros_gen.client.plan.provisions import plan_provisions
from microros_gen.client.plan.queues import check_pool_key
from microros_gen.client.plan.receiving import plan_receiving
from microros_gen.client.plan.running import plan_running
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import NodePlan, PublisherPlan, SubscriptionPlan
from microros_gen.client.plan.senders import SentStorage, plan_sent_storage
from microros_gen.client.plan.serving import Serving, plan_serving
from microros_gen.client.plan.session_times import plan_times
from microros_gen.client.plan.slices import (
    DISCOVERY_GROUP,
    LINE_CHUNK,
    CreationPlan,
    ErrorsPlan,
    InputPlan,
    MemoryPlan,
    OutputPlan,
    SessionPlan,
    TransportPlan,
)
from microros_gen.client.plan.streams import StreamSizes, Written, plan_streams
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.dds_names import dds_topic, dds_type, participant_name
from microros_gen.interfaces.types import Message, TypeName
from microros_gen.platform.provide import Provisions
from microros_gen.platform.target import Target
from microros_gen.records import dataclass
from microros_gen.selection.model import Selection
from microros_gen.typesupport.plan.own_limits import LimitSet
from microros_gen.typesupport.plan.types import TypePlan

SESSION_ID = 0x81
DEFAULT_NAME_SIZE = 64
DEFAULT_SILENCE_MS = 10_000
"""Of the component liveliness_hard without `session.hard_liveliness`; the public client has the same."""
ERROR_TEXT_SIZE = 160
_FRAMING = {True: "on", False: "off", None: "either"}


@dataclass(frozen=True)
class Project:
    """Everything that the renderer prints. `name` names the image: the profiles joined by `+`.

    `roots` and `services` as of plan_project.
    """

    name: str
    application: Application
    selection: Selection
    target: Target
    types: tuple[TypePlan, ...]
    roots: tuple[TypeName, ...]
    streams: StreamSizes
    runtime: RuntimePlan
    board: BoardPlan
    storage: SentStorage
    provisions: Provisions
    services: tuple[TypeName, ...] = ()

    @cached_property
    def messages(self) -> Mapping[TypeName, Message]:
        """The messages of all types, by name."""
        return {plan.name: plan.message for plan in self.types}

    def own_limits(self, publisher: PublisherPlan) -> LimitSet | None:
        """Return the publisher's own limits; None: those of its type."""
        plan = next(plan for plan in self.types if plan.name == publisher.type)
        return plan.limit_set("publisher", publisher.index)

    @property
    def lacks_image(self) -> str:
        """Why the example is not linked to an image; empty where it is."""
        os = self.target.part("os")
        if self.target.knows_memory and not self.target.has_image and os is not None:
            return f"start-up code and linker script belong to {os.component.name}: link the library to your firmware"
        if not self.target.has_image:
            return (
                f"target {self.target.name} names a processor and no memory: link the library to your firmware,"
                f" or write a target file that extends it with `flash` and `ram`"
            )
        functions = (*self.provisions.functions(in_example=True), *self.board.hooks)
        return f"your application provides {', '.join(functions)} (microros/port.h)" if functions else ""

    @property
    def image(self) -> str:
        """The file name of the image below bin/."""
        return f"{self.name}{self.target.image_suffix}"

    @property
    def linker_script(self) -> str | None:
        """The path of the linker script below the output folder, where the target has a board."""
        return self.target.linker_script

    @property
    def example(self) -> str:
        """The path of the example application below the output folder."""
        return f"examples/{self.name}/main.c"


def plan_project(
    application: Application,
    selection: Selection,
    target: Target,
    types: tuple[TypePlan, ...],
    roots: tuple[TypeName, ...],
    diagnostics: Diagnostics,
    services: tuple[TypeName, ...] = (),
) -> Project:
    """Size and name everything. Errors are collected; the result is only valid without errors.

    `roots` are the messages and `services` the services that an application without `nodes:` can have.
    """
    name = selection.name
    by_name = {plan.name: plan for plan in types}
    nodes, publishers = _declared(application, by_name)
    receiving = plan_receiving(application, selection, by_name, roots, diagnostics)
    serving = plan_serving(application, selection, by_name, services, diagnostics)
    queues = (*receiving.queues, *serving.queues)
    check_pool_key(application, queues, diagnostics)
    endpoints: list[PublisherPlan | SubscriptionPlan] = [*publishers, *receiving.subscriptions]
    names = (*roots, *(type_name(e.type) for e in application.implied))
    create, create_text = _create_size(
        application, selection, nodes, tuple(endpoints), names, serving, services
    )
    own_driver = has_own_line(target, selection.transport)
    streams = plan_streams(
        application,
        selection.transport,
        (*_written_by_publishers(application, selection, by_name, roots), *serving.written),
        create,
        diagnostics,
        selection.has("stream_reliable_input"),
        (*receiving.received, *serving.received),
        create_text,
        # Memory that survives a sleep ends before the input buffer.
        lends_input=bool(nodes)
        and not selection.has("sleep_cycles")
        and all(queue.asked is None for queue in queues),
        keeps_output=own_driver,
    )
    receivers = receiving.subscriptions_max + serving.services_max + serving.clients_max
    receivers -= implied(application, "subscription", "service", "client")  # nobody adds these to an executor
    running = plan_running(application, selection, receivers, diagnostics)
    storage = plan_sent_storage(application, selection, by_name, roots, services)
    baud = application.transport.baud if selection.transport == "serial" else None
    runtime = RuntimePlan(
        plan_id="",
        session=SessionPlan(
            id=SESSION_ID,
            client_key=_client_key(application, selection, target, name),
            multithread=selection.has("multithread"),
            hard_liveliness_ms=_hard_liveliness(application, selection),
            has_state=selection.has("session_state"),
            has_sleep=selection.has("sleep_cycles"),
            has_time_sync=selection.has("time_sync"),
        ),
        times=plan_times(application.times, baud, streams.mtu, streams.input_size),
        transport=_transport(application, selection, target, streams, own_driver),
        streams=OutputPlan(
            mtu=streams.mtu,
            best_effort_size=streams.best_effort_size,
            reliable_slots=streams.reliable_slots,
            reliable_slot_size=streams.reliable_slot_size,
            on_full=application.on_full,
            on_full_block_ms=application.on_full_block_ms,
            fragments=streams.fragments,
        ),
        input=InputPlan(
            size=streams.input_size,
            reader=streams.input_reader,
            free=streams.input_free,
            arrives_in_fragments=streams.arrives_in_fragments,
            reliable_slots=streams.reliable_input_slots,
            reliable_slot_size=streams.input_size if streams.reliable_input_slots else 0,
            queues=queues,
        ),
        creation=CreationPlan(
            entities=selection.entities,
            stream=application.creation.name if application.creation else "best_effort",
            size=streams.creation_size,
        ),
        entities=EntitiesPlan(
            declared=bool(nodes),
            nodes=Places(len(nodes) or pool(application, "nodes", 1, diagnostics), nodes),
            publishers=Places(
                _publishers_max(application, selection, publishers, roots, diagnostics),
                publishers,
                implied(application, "publisher"),
            ),
            subscriptions=Places(
                receiving.subscriptions_max, receiving.subscriptions, implied(application, "subscription")
            ),
            services=Places(serving.services_max, serving.services, implied(application, "service")),
            clients=Places(serving.clients_max, serving.clients, implied(application, "client")),
            name_size=0 if nodes else application.pools.get("name_size", DEFAULT_NAME_SIZE),
            type_name_size=0 if nodes else _longest_type((*names, *services)) + 1,
            timed_qos=timed_qos(application, selection.entities, diagnostics),
        ),
        memory=MemoryPlan(
            arena_size=application.memory.arena,
            fixed_messages=all(plan.fixed_size for plan in types if plan.wire is not None),
            kept_messages=storage.kept,
            message_pools=storage.pools,
        ),
        errors=ErrorsPlan(text_size=ERROR_TEXT_SIZE if application.error_text else 0),
        timers=running.timers,
        executor=running.executor,
        clock=running.clock,
    )
    board = plan_board(application, target, runtime, diagnostics)
    own_line = runtime.transport.kind == "serial" and not target.hosted and not board.has_serial_driver
    runtime = replace(runtime, transport=replace(runtime.transport, own_line=own_line))
    identities = (c.component.identity for c in selection.components)
    runtime = replace(runtime, plan_id=plan_id(runtime, identities, types))
    provisions = plan_provisions(application, selection, runtime, board, target, diagnostics)
    return Project(
        name,
        application,
        selection,
        target,
        types,
        roots,
        streams,
        runtime,
        board,
        storage,
        provisions,
        services,
    )


def _transport(
    application: Application, selection: Selection, target: Target, streams: StreamSizes, own_driver: bool
) -> TransportPlan:
    asked = application.transport
    host, port = _agent(asked, selection)
    return TransportPlan(
        kind=selection.transport,
        agent_host=host,
        agent_port=port,
        has_discovery=selection.has("discovery"),
        discovery_port=asked.discover or DISCOVERY_PORT,
        framing=_FRAMING[asked.framing],
        device=asked.device if selection.transport == "serial" and target.hosted else "",
        baud=asked.baud,
        send_buffer=streams.send_buffer,
        keeps_output=streams.keeps_output,
        line_input=streams.line_input,
        line_chunk=RING_CHUNK if own_driver else LINE_CHUNK,
        read_polls=asked.read_polls,
    )


def _declared(
    application: Application, types: Mapping[TypeName, TypePlan]
) -> tuple[tuple[NodePlan, ...], tuple[PublisherPlan, ...]]:
    nodes = tuple(
        NodePlan(
            i,
            n.name,
            n.namespace,
            participant_name(n.name, n.namespace),
            n.domain_id,
            n.given_name,
            n.given_namespace,
        )
        for i, n in enumerate(application.nodes)
    )
    publishers = []
    for index, (node_index, node, endpoint) in enumerate(declarations(application, "publisher")):
        topic = expand_topic_name(endpoint.topic, node.name, node.namespace)
        reliable = endpoint.qos.reliability == "reliable"
        name = type_name(endpoint.type)
        own = types[name].limit_set("publisher", index)
        publishers.append(
            PublisherPlan(
                index,
                node_index,
                topic,
                dds_topic(topic),
                name,
                reliable,
                own.name if own else "",
                endpoint.given,
            )
        )
    return nodes, tuple(publishers)


def _written_by_publishers(
    application: Application,
    selection: Selection,
    types: Mapping[TypeName, TypePlan],
    roots: tuple[TypeName, ...],
) -> tuple[Written, ...]:
    if not selection.has("publish"):
        return ()
    if not application.nodes:
        return tuple(
            Written(str(r), types[r].max_encoded_size, True, True, named_at(application, r)) for r in roots
        )
    declared = enumerate(declarations(application, "publisher"))
    return tuple(_written(index, node, endpoint, types) for index, (_, node, endpoint) in declared)


def _written(
    index: int, node: NodeDecl, endpoint: EndpointDecl, types: Mapping[TypeName, TypePlan]
) -> Written:
    size = types[type_name(endpoint.type)].largest("publisher", index)
    reliable = endpoint.qos.reliability == "reliable"
    label = f"{endpoint.type} on {expand_topic_name(endpoint.topic, node.name, node.namespace)}"
    return Written(label, size, reliable, not reliable, endpoint.type_span or endpoint.span)


def _create_size(
    application: Application,
    selection: Selection,
    nodes: tuple[NodePlan, ...],
    endpoints: tuple[PublisherPlan | SubscriptionPlan, ...],
    roots: tuple[TypeName, ...],
    serving: Serving,
    services: tuple[TypeName, ...],
) -> tuple[int, int]:
    """Return the size of the largest CREATE and how much of it is text; 0: the client creates nothing."""
    if selection.entities == "preconfigured":
        return 0, 0
    longest_type = _longest_type(roots)
    if not nodes:
        size = application.pools.get("name_size", DEFAULT_NAME_SIZE) - 1
        # A namespace takes `size` with its slash in front, which its reference does not have.
        reference = participant_reference("x" * 2 * size, application.pools.get("nodes", 1))
        places = serving.services_max + serving.clients_max
        of_service = (size, _longest_type(services)) if places else (0, 0)
        names = CreateNames(2 * size + 1, size + len("rt"), longest_type, len(reference), *of_service)
    else:
        names = CreateNames(
            max(len(n.participant_name) for n in nodes),
            max((len(p.dds_topic) for p in endpoints), default=len("rt/")),
            max((len(p.dds_type) for p in endpoints), default=0),
            max(len(participant_reference(n.participant_name, len(nodes))) for n in nodes),
            max((len(s.name) for s in (*serving.services, *serving.clients)), default=0),
            max((len(s.dds_type) for s in (*serving.services, *serving.clients)), default=0),
        )
    size = create_size(names, selection.entities)
    return size, create_text(size, names, selection.entities)


def _longest_type(roots: tuple[TypeName, ...]) -> int:
    return max((len(dds_type(r)) for r in roots), default=0)


def _publishers_max(
    application: Application,
    selection: Selection,
    publishers: tuple[PublisherPlan, ...],
    roots: tuple[TypeName, ...],
    diagnostics: Diagnostics,
) -> int:
    least = 1 if selection.has("publish") and selection.has("read") else 0
    if application.nodes:
        return max(len(publishers), least)
    default = len(roots) if selection.has("publish") else 0
    return max(pool(application, "publishers", default, diagnostics), least)


def _client_key(application: Application, selection: Selection, target: Target, name: str) -> int | None:
    """Return the fixed key, or None where the port supplies it: no two devices share that one.

    The key is fixed where the file names it, where the agent knows the client by it (`entities: preconfigured`), and
    where the target has no unique id (`plan_board` warns). Then it follows from the application, so that
    different applications do not take each other's session.
    """
    if isinstance(application.session_key, str):
        return None
    if application.session_key is not None:
        return application.session_key
    if target.has_unique_id and selection.entities != "preconfigured":
        return None
    text = "/".join([name, *(participant_name(n.name, n.namespace) for n in application.nodes)])
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big") or 1


def _hard_liveliness(application: Application, selection: Selection) -> int:
    asked = application.hard_liveliness_ms
    return asked or (DEFAULT_SILENCE_MS if selection.has("liveliness_hard") else 0)


def _agent(transport: Transport, selection: Selection) -> tuple[str, int]:
    """Return host and port of the agent; the group where agents are asked for when none is named."""
    if transport.discover is not None:
        return DISCOVERY_GROUP, transport.discover
    if selection.has("discovery") and transport.agent_span is None:
        return DISCOVERY_GROUP, DISCOVERY_PORT
    return transport.host, transport.port
