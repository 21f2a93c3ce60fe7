# SPDX-License-Identifier: Apache-2.0
"""The whole plan: entities, streams, pools and names of one selection, as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property

from microros_gen.application.model import Application
from microros_gen.client.plan.board import BoardPlan, has_own_line, plan_board
from microros_gen.client.plan.create_messages import DEFAULT_NAME_SIZE, largest_create, longest_type
from microros_gen.client.plan.declared import implied, pool, timed_qos, type_name, without_handle
from microros_gen.client.plan.entities import EntitiesPlan, Places
from microros_gen.client.plan.features import PlanContext, plan_features
from microros_gen.client.plan.line_load import LineLoad, plan_line_load
from microros_gen.client.plan.line_media import medium_of
from microros_gen.client.plan.messages import plan_messages
from microros_gen.client.plan.nodes import plan_nodes
from microros_gen.client.plan.plan_id import plan_id
from microros_gen.client.plan.provisions import plan_provisions
from microros_gen.client.plan.publishing import plan_publishing
from microros_gen.client.plan.queues import check_pool_key
from microros_gen.client.plan.receiving import plan_receiving
from microros_gen.client.plan.running import plan_running
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import PublisherPlan, QueuePlan, SubscriptionPlan
from microros_gen.client.plan.senders import SentStorage, plan_sent_storage
from microros_gen.client.plan.serving import plan_serving
from microros_gen.client.plan.session import plan_session
from microros_gen.client.plan.session_times import TimesPlan, plan_times
from microros_gen.client.plan.slices import CreationPlan, ErrorsPlan, InputPlan, MemoryPlan, OutputPlan
from microros_gen.client.plan.streams import StreamSizes, plan_streams
from microros_gen.client.plan.transport import plan_transport
from microros_gen.client.plan.transport_sizes import part_size
from microros_gen.client.plan.values import Values
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import Message, TypeName
from microros_gen.platform.provide import Provisions
from microros_gen.platform.target import Target
from microros_gen.records import dataclass
from microros_gen.selection.declared import STREAM_BEST_EFFORT, STREAM_RELIABLE, STREAM_RELIABLE_INPUT
from microros_gen.selection.model import Selection
from microros_gen.typesupport.plan.layout import models_of
from microros_gen.typesupport.plan.own_limits import LimitSet
from microros_gen.typesupport.plan.types import TypePlan

ERROR_TEXT_SIZE = 160

LOANS = "microros/xrce_loan.h"
"""A component that replaces this header lets the application use samples where they wait."""


@dataclass(frozen=True)
class Project:
    """Everything that the renderer prints. `name` names the image: the profiles joined by `+`.

    `roots` and `services` as of plan_project. `line`: what the publishers with a rate need of it; None: none has one.
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
    line: LineLoad | None = None

    @cached_property
    def messages(self) -> Mapping[TypeName, Message]:
        """The messages of all types, by name."""
        return {plan.name: plan.message for plan in self.types}

    @cached_property
    def values(self) -> Values:
        """The plan's attributes by their path, as component.yaml names them."""
        return Values(self.runtime, self.selection, self.board, self.target)

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
    def stack_meets_variables(self) -> bool:
        """Whether nothing limits the stack of the image: it grows towards the variables, in the same RAM."""
        return self.target.ram is not None and self.target.cpu.starts_itself and not self.lacks_image

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


def _uses_samples_in_place(selection: Selection) -> bool:
    return any(r.header == LOANS for c in selection.components for r in c.component.contributes.replaces)


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
    session = plan_session(application, selection, target, name)
    nodes = plan_nodes(application)
    publishing = plan_publishing(application, selection, by_name, roots, diagnostics)
    receiving = plan_receiving(application, selection, by_name, roots, diagnostics)
    serving = plan_serving(application, selection, by_name, services, diagnostics)
    queues = (*receiving.queues, *serving.queues)
    check_pool_key(application, queues, diagnostics)
    endpoints: list[PublisherPlan | SubscriptionPlan] = [*publishing.publishers, *receiving.subscriptions]
    names = (*roots, *(type_name(e.type) for e in application.implied))
    create, create_text = largest_create(
        application, selection, nodes, tuple(endpoints), names, serving, services
    )
    own_driver = has_own_line(target, selection.transport)
    streams = plan_streams(
        application,
        selection.transport,
        (*publishing.written, *serving.written),
        create,
        diagnostics,
        selection.has(STREAM_RELIABLE_INPUT),
        (*receiving.received, *serving.received),
        create_text,
        # Memory that survives a sleep ends before the input buffer; a sample that is in use must not be overwritten.
        lends_input=bool(nodes)
        and not session.has_sleep
        and not _uses_samples_in_place(selection)
        and all(queue.requested_bytes is None for queue in queues),
        keeps_output=own_driver,
        reliable_output=selection.has(STREAM_RELIABLE),
        best_effort_output=selection.has(STREAM_BEST_EFFORT),
    )
    if any(c.component.fills_messages for c in selection.components):
        part = part_size(selection.transport, streams.mtu, streams.send_buffer, application)
        streams = replace(streams, mtu=max(streams.mtu, part))
    receivers = receiving.subscriptions_max + serving.services_max + serving.clients_max
    receivers -= without_handle(application, "subscription", "service", "client")
    running = plan_running(application, selection, receivers, diagnostics)
    storage = plan_sent_storage(
        application, selection, by_name, roots, services, models_of(target.data_model)
    )

    medium = medium_of(selection.transport, application)

    def times(rate: int | None) -> TimesPlan:
        baud = rate if medium.kind == "serial" else None
        sent, received = streams.mtu + medium.overhead, streams.input_size + medium.overhead
        return plan_times(application.times, baud, sent, received)

    line = plan_line_load(
        application,
        publishing.written,
        streams.mtu,
        medium,
        lambda rate: times(rate).heartbeat_period_ms,
        diagnostics,
    )
    runtime = RuntimePlan(
        plan_id="",
        session=session,
        times=times(medium.rate),
        transport=plan_transport(application, selection, target, streams, own_driver),
        streams=_output(application, streams),
        input=_input(streams, queues),
        creation=CreationPlan(
            entities=selection.entities,
            stream=application.creation.name if application.creation else "best_effort",
            size=streams.creation_size,
            fragments=streams.creation_fragments,
        ),
        entities=EntitiesPlan(
            declared=bool(nodes),
            nodes=Places(len(nodes) or pool(application, "nodes", 1, diagnostics), nodes),
            publishers=Places(
                publishing.publishers_max, publishing.publishers, implied(application, "publisher")
            ),
            subscriptions=Places(
                receiving.subscriptions_max, receiving.subscriptions, implied(application, "subscription")
            ),
            services=Places(serving.services_max, serving.services, implied(application, "service")),
            clients=Places(serving.clients_max, serving.clients, implied(application, "client")),
            name_size=0 if nodes else application.pools.get("name_size", DEFAULT_NAME_SIZE),
            type_name_size=0 if nodes else longest_type((*names, *services)) + 1,
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
        messages=plan_messages(types),
    )
    board = plan_board(application, target, runtime, diagnostics)
    has_driver = target.names_lines or board.has_serial_driver
    own_line = runtime.transport.kind == "serial" and ("serial" in target.own_capabilities or not has_driver)
    runtime = replace(runtime, transport=replace(runtime.transport, own_line=own_line))
    context = PlanContext(application, selection, target, by_name, runtime, line)
    runtime = replace(runtime, features=plan_features(context, diagnostics))
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
        line,
    )


def _output(application: Application, streams: StreamSizes) -> OutputPlan:
    return OutputPlan(
        mtu=streams.mtu,
        best_effort_size=streams.best_effort_size,
        reliable_slots=streams.reliable_slots,
        reliable_slot_size=streams.reliable_slot_size,
        on_full=application.on_full,
        on_full_block_ms=application.on_full_block_ms,
        fragments=streams.fragments,
        best_effort_slots=streams.best_effort_slots,
        best_effort_places=streams.best_effort_places,
    )


def _input(streams: StreamSizes, queues: tuple[QueuePlan, ...]) -> InputPlan:
    return InputPlan(
        size=streams.input_size,
        reader=streams.input_reader,
        free=streams.input_free,
        arrives_in_fragments=streams.arrives_in_fragments,
        reliable_slots=streams.reliable_input_slots,
        reliable_slot_size=streams.input_size if streams.reliable_input_slots else 0,
        queues=queues,
    )
