# SPDX-License-Identifier: Apache-2.0
"""What the declarations of an application ask for: components of the API, and streams."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator
from dataclasses import replace

from microros_gen.application import diagnosis_decl, silence, time_source
from microros_gen.application.kinds import KIND
from microros_gen.application.model import Application, EndpointDecl, ExecutorDecl, NodeDecl
from microros_gen.application.names import expand_topic_name
from microros_gen.application.task_decl import KEY as TASKS
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.records import dataclass

STREAM_BEST_EFFORT = "stream_best_effort"
STREAM_BEST_EFFORT_INPUT = "stream_best_effort_input"
STREAM_RELIABLE = "stream_reliable"
STREAM_RELIABLE_INPUT = "stream_reliable_input"
_HELD = "parameters_held"
_DELIVERY = {"local": "local_delivery", "peer": "peer"}
"""The component of each key of an endpoint that says where messages go without an agent."""


@dataclass(frozen=True)
class Demand:
    """`component` is asked for by `text` (readable, with its place), which stands at `span`."""

    component: str
    text: str
    span: Span | None = None


def at(span: Span | None) -> str:
    """Return ` (microros.yaml:12)`, or nothing where there is no place."""
    return f" ({span.source.name}:{span.line})" if span else ""


def declared_components(application: Application) -> Iterator[Demand]:
    """Yield the micro-ROS component that each declaration of a node needs in order to be created at all.

    A profile, or the application, chooses them: what is declared without its component is an error.
    """
    for node in application.nodes:
        for endpoint in node.endpoints:
            yield Demand(KIND[endpoint.kind].component, _article(endpoint.kind), endpoint.span)
            if endpoint.managed:
                yield Demand("lifecycle", "a managed publisher", endpoint.span)
        for timer in node.timers:
            yield Demand("timers", "a timer", timer.span)
            if timer.managed:
                yield Demand("lifecycle", "a managed timer", timer.span)
        for parameter in node.parameters:
            yield Demand("parameters", "a parameter", parameter.span)
        for action in node.actions:
            yield Demand("action_server", "an action server", action.span)
        for caller in node.action_clients:
            yield Demand("action_client", "an action client", caller.span)
        for client in node.parameter_clients:
            yield Demand("parameter_client", "a client of parameters", client.span)
            if "watch" in client.operations:
                yield Demand(KIND["subscription"].component, "a client that watches parameters", client.span)
        for executor in node.executors:
            yield Demand("executor", "an executor", executor.span)
    for key, declared in (
        (diagnosis_decl.KEY, application.diagnosis),
        (time_source.KEY, application.time_source),
    ):
        if declared is not None:
            yield Demand(key, f"`{key}:`", application.spans.get(key))


def selecting_demands(application: Application) -> Iterator[Demand]:
    """Yield the component that a key of a node selects by itself, since nothing else can be meant by it."""
    yield from holder_demands(application)
    for task in application.tasks[:1]:
        yield Demand(TASKS, f"`{TASKS}:`{at(task.span)}", task.span)
    for node in application.nodes:
        for mode in node.modes[:1]:
            yield Demand("node_modes", f"modes: of a node{at(mode.span)}", mode.span)
        for endpoint in node.endpoints:
            for key, value in (("local", endpoint.local), ("peer", endpoint.peer)):
                if value != "never":
                    text = f"{key}: {value} of {endpoint.topic}{at(endpoint.span)}"
                    yield Demand(_DELIVERY[key], text, endpoint.span)
            if endpoint.silence is not None:
                text = f"{silence.KEY}: of {endpoint.topic}{at(endpoint.silence.span)}"
                yield Demand(silence.KEY, text, endpoint.silence.span)


def without_components(nodes: Iterable[NodeDecl], dropped: Container[str]) -> tuple[NodeDecl, ...]:
    """Return the nodes without what needs one of the components `dropped`."""
    return tuple(_without(node, dropped) for node in nodes)


def _without(node: NodeDecl, dropped: Container[str]) -> NodeDecl:
    """Return a node of the components that are left; without a life cycle nothing of it is managed."""
    has_parameters = "parameters" not in dropped
    node = replace(
        node,
        endpoints=tuple(e for e in node.endpoints if KIND[e.kind].component not in dropped),
        timers=node.timers if "timers" not in dropped else (),
        parameters=node.parameters if has_parameters else (),
        parameters_at=node.parameters_at if has_parameters else None,
        parameter_clients=node.parameter_clients if "parameter_client" not in dropped else (),
        modes=node.modes if has_parameters and "node_modes" not in dropped else (),
        actions=node.actions if "action_server" not in dropped else (),
        action_clients=node.action_clients if "action_client" not in dropped else (),
    )
    if "lifecycle" in dropped:
        endpoints = tuple(replace(endpoint, managed=False) for endpoint in node.endpoints)
        timers = tuple(replace(timer, managed=False) for timer in node.timers)
        node = replace(node, endpoints=endpoints, timers=timers)
    return replace(node, executors=_executors(node) if "executor" not in dropped else ())


def _executors(node: NodeDecl) -> tuple[ExecutorDecl, ...]:
    """Return the executors of a node with those handles that the node still has; one without any is left out."""
    known = {timer.name for timer in node.timers} | {endpoint.topic for endpoint in node.endpoints}
    found = []
    for executor in node.executors:
        handles = tuple(handle for handle in executor.handles if handle.name in known)
        if handles or not executor.handles:
            found.append(replace(executor, handles=handles))
    return tuple(found)


def holder_demands(application: Application) -> Iterator[Demand]:
    """Yield the component by which another node holds the parameters, for each node that says so."""
    for node in application.nodes:
        if node.parameters_at is not None and node.parameters_at.name == "agent":
            yield Demand(
                _HELD,
                f"parameters: {{at: agent}}{at(node.parameters_at.span)}",
                node.parameters_at.span,
            )


def check_holder(application: Application, selected: Container[str], diagnostics: Diagnostics) -> None:
    """Report the component of held parameters where it is selected, but no node says that its own are held."""
    if _HELD in selected and not any(holder_demands(application)):
        message = f"the component '{_HELD}' is for nodes whose parameters a server elsewhere holds"
        hint = "Write `parameters: {at: agent}` at each node"
        diagnostics.error(message, application.spans.get("components"), hint, id="MG-4090")


def stream_demands(application: Application, selected: frozenset[str], entities: str) -> Iterator[Demand]:
    """Yield the streams that entities and their creation need, for the components that are `selected`.

    A client that creates no entities (`preconfigured`) creates nothing. Without `nodes:` any entity
    may be created, reliable ones too: rclc_publisher_init_default and rclc_subscription_init_default are.
    """
    if entities != "preconfigured":
        yield from _creation_demands(application, entities)
    if application.nodes:
        for node in application.nodes:
            for endpoint in node.endpoints:
                yield from _endpoint_demands(node, endpoint, selected)
        return
    span = application.spans.get("interfaces")
    if "publish" in selected:
        text = "publishers without `nodes:` ({} makes a {} one)"
        yield Demand(STREAM_RELIABLE, text.format("rclc_publisher_init_default", "reliable"), span)
        yield Demand(STREAM_BEST_EFFORT, text.format("rclc_publisher_init_best_effort", "best effort"), span)
    if "subscribe" in selected:
        text = "subscriptions without `nodes:` (rclc_subscription_init_default makes a reliable one)"
        yield Demand(STREAM_RELIABLE_INPUT, text, span)
        text = "subscriptions without `nodes:` (rclc_subscription_init_best_effort makes a best effort one)"
        yield Demand(STREAM_BEST_EFFORT_INPUT, text, span)


def _creation_demands(application: Application, entities: str) -> Iterator[Demand]:
    creation = application.creation
    if creation is None or creation.name != "reliable":
        yield Demand(STREAM_BEST_EFFORT, f"entities: {entities} (CREATE goes on the best effort stream)")
        return
    create = "creation: reliable (CREATE goes on the reliable stream)"
    status = "creation: reliable (STATUS comes on the agent's reliable stream)"
    yield Demand(STREAM_RELIABLE, create, creation.span)
    yield Demand(STREAM_RELIABLE_INPUT, status, creation.span)


def _endpoint_demands(node: NodeDecl, endpoint: EndpointDecl, selected: frozenset[str]) -> Iterator[Demand]:
    if KIND[endpoint.kind].component not in selected:
        return
    reliable = endpoint.qos.reliability == "reliable"
    where = f"{expand_topic_name(endpoint.topic, node.name, node.namespace)}{at(endpoint.span)}"
    if endpoint.kind == "publisher":
        stream = STREAM_RELIABLE if reliable else STREAM_BEST_EFFORT
        yield Demand(stream, f"a {_reliability(reliable)} publisher on {where}", endpoint.span)
    elif endpoint.kind == "subscription":
        stream = STREAM_RELIABLE_INPUT if reliable else STREAM_BEST_EFFORT_INPUT
        yield Demand(stream, f"a {_reliability(reliable)} subscription on {where}", endpoint.span)


def _reliability(reliable: bool) -> str:
    return "reliable" if reliable else "best effort"


def _article(kind: str) -> str:
    return f"a {kind}"
