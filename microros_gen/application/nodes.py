# SPDX-License-Identifier: Apache-2.0
"""`nodes:` of the application file → node declarations, with the rules of ROS 2 for names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import count

from microros_gen.application import silence
from microros_gen.application.actions import parse_action_clients, parse_actions
from microros_gen.application.kinds import KIND, KINDS
from microros_gen.application.limits import endpoint_limits
from microros_gen.application.model import EndpointDecl, ExecutorDecl, NodeDecl, ParameterDecl, TimerDecl
from microros_gen.application.modes import parse_modes
from microros_gen.application.names import (
    absolute,
    expand_topic_name,
    expanded_fault,
    namespace_fault,
    node_name_fault,
    substitute,
    topic_fault,
)
from microros_gen.application.parameter_clients import parse_parameter_clients
from microros_gen.application.parameters import parse_declarations
from microros_gen.application.qos import endpoint_qos
from microros_gen.application.remap import rename_endpoints, rename_node
from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.tree_values import (
    bool_of,
    child,
    int_of,
    items,
    named_of,
    rate_of,
    report_name,
    span_of,
    text_of,
    time_of,
)
from microros_gen.documents.yaml_tree import YamlNode


def parse_nodes(tree: YamlNode | None, diagnostics: Diagnostics) -> tuple[NodeDecl, ...]:
    """Return the declarations below `nodes:`; faulty names and references are errors at their places."""
    nodes = tuple(_node(item, diagnostics) for item in items(tree))
    seen: dict[str, NodeDecl] = {}
    for node in nodes:
        full = expand_topic_name(node.name, node.name, node.namespace)
        first = seen.setdefault(full, node)
        if first is not node and first.name_span:
            message = f"duplicate node '{full}'; the first is in line {first.name_span.line}"
            diagnostics.error(
                message, node.name_span, "Give each a different name or namespace", id="MG-3002"
            )
    _check_holders(nodes, diagnostics)
    return nodes


def _check_holders(nodes: tuple[NodeDecl, ...], diagnostics: Diagnostics) -> None:
    """Report nodes whose parameters are held elsewhere than those of the nodes before."""
    having = [node for node in nodes if node.parameters_at or node.parameters or node.parameter_file]
    holders = [(node, node.parameters_at.name if node.parameters_at else "device") for node in having]
    for node, holder in holders[1:]:
        if holder != holders[0][1]:
            first = holders[0][0].name
            message = f"the parameters of '{node.name}' are held by the {holder}, those of '{first}' are not"
            span = node.parameters_at.span if node.parameters_at else node.name_span
            diagnostics.error(message, span, f"Write at: {holders[0][1]} at each node", id="MG-3080")


def _node(item: YamlNode, diagnostics: Diagnostics) -> NodeDecl:
    name, namespace = child(item, "name"), child(item, "namespace")
    report_name(name, "the node name", node_name_fault, diagnostics)
    placed = namespace is None or report_name(namespace, "the namespace", namespace_fault, diagnostics)
    node = NodeDecl(
        name=text_of(name) or "",
        namespace=absolute((text_of(namespace) if placed else None) or "/"),
        domain_id=int_of(child(item, "domain_id")) or 0,
        span=item.span,
        timers=tuple(_timer(t, diagnostics) for t in items(child(item, "timers"))),
        parameters=parse_declarations(child(item, "parameters"), diagnostics),
        parameter_file=named_of(child(child(item, "parameters"), "file")),
        parameters_at=named_of(child(child(item, "parameters"), "at")),
        modes=parse_modes(child(item, "modes"), diagnostics),
        name_span=span_of(name) or item.span,
    )
    remap = child(item, "remap")
    node = rename_node(node, remap, diagnostics)
    clients = parse_parameter_clients(
        child(item, "parameter_clients"), node.name, node.namespace, diagnostics
    )
    actions = parse_actions(child(item, "actions"), node.name, node.namespace, diagnostics)
    callers = parse_action_clients(child(item, "action_clients"), node.name, node.namespace, diagnostics)
    node = replace(
        node,
        endpoints=tuple(_endpoints(item, node, diagnostics)),
        parameter_clients=tuple(clients),
        actions=tuple(actions),
        action_clients=tuple(callers),
    )
    executors = tuple(_executor(e, node, diagnostics) for e in items(child(item, "executors")))
    for kind, named in (("timer", node.timers), ("parameter", node.parameters), ("executor", executors)):
        check_unique(kind, [(n.name, n.span) for n in named], diagnostics)
    for mode in node.modes:
        values = [(v.parameter, v.name_span) for v in mode.values]
        check_unique("parameter of a mode", values, diagnostics, "Remove it")
    for kind, actions_of in (("action", node.actions), ("action client", node.action_clients)):
        check_unique(kind, [(a.name, a.span) for a in actions_of], diagnostics)
    check_unique(
        "parameter client", [(c.node, c.span) for c in node.parameter_clients], diagnostics, "Remove it"
    )
    return rename_endpoints(replace(node, executors=executors), remap, diagnostics)


def with_declarations(
    node: NodeDecl, declared: tuple[ParameterDecl, ...], diagnostics: Diagnostics
) -> NodeDecl:
    """Return the node with further parameters before those that it has; no name may come twice."""
    every = (*declared, *node.parameters)
    check_unique("parameter", [(p.name, p.span) for p in every], diagnostics)
    return replace(node, parameters=every)


def _endpoints(item: YamlNode, node: NodeDecl, diagnostics: Diagnostics) -> Iterator[EndpointDecl]:
    for kind in KINDS:
        for endpoint in items(child(item, kind.key)):
            name, type_node = child(endpoint, kind.name_key), child(endpoint, "type")
            what = "the service name" if kind.service_type else "the topic name"
            if report_name(name, what, topic_fault, diagnostics):
                _check_expanded(name, what, node, diagnostics)
            type_name = text_of(type_node) or ""
            yield EndpointDecl(
                kind=kind.name,
                topic=substitute(text_of(name) or "", node.name, node.namespace),
                type=type_name,
                qos=endpoint_qos(child(endpoint, "qos"), diagnostics),
                limits=endpoint_limits(child(endpoint, "limits"), type_name),
                span=endpoint.span,
                type_span=span_of(type_node),
                topic_span=span_of(name),
                queue=int_of(child(endpoint, "queue")),
                queue_bytes=int_of(child(endpoint, "queue_bytes")),
                queue_bytes_span=span_of(child(endpoint, "queue_bytes")),
                stored=text_of(child(endpoint, "storage")) != "none",
                managed=bool_of(child(endpoint, "managed")) is True,
                local=text_of(child(endpoint, "local")) or EndpointDecl.local,
                peer=text_of(child(endpoint, "peer")) or EndpointDecl.peer,
                interval_us=rate_of(child(endpoint, "rate")),
                rate_span=span_of(child(endpoint, "rate")),
                silence=silence.parse_silence(
                    child(endpoint, silence.KEY), _elsewhere(endpoint), diagnostics
                ),
            )


def _elsewhere(endpoint: YamlNode) -> str:
    """Return the first key of an endpoint by which messages come without an agent, with its value; empty: none."""
    found = ((key, text_of(child(endpoint, key))) for key in ("local", "peer"))
    return next((f"{key}: {value}" for key, value in found if value not in (None, "never")), "")


def _check_expanded(name: YamlNode | None, what: str, node: NodeDecl, diagnostics: Diagnostics) -> None:
    text = text_of(name)
    if text is not None and name is not None and node.name:
        fault = expanded_fault(expand_topic_name(text, node.name, node.namespace))
        if fault:
            full = expand_topic_name(text, node.name, node.namespace)
            shown = full if len(full) <= 60 else f"{full[:60]}…"
            diagnostics.error(f"{what} '{shown}' {fault.message}", name.span, fault.hint, id=fault.id)


def _timer(item: YamlNode, diagnostics: Diagnostics) -> TimerDecl:
    return TimerDecl(
        name=text_of(child(item, "name")) or "",
        period_us=positive_time(item, "period", diagnostics) or 0,
        span=item.span,
        kind=text_of(child(item, "kind")) or TimerDecl.kind,
        managed=bool_of(child(item, "managed")) is True,
    )


def positive_time(item: YamlNode, key: str, diagnostics: Diagnostics) -> int | None:
    """Return the time of `key` in microseconds; less than one is an error."""
    node = child(item, key)
    time = time_of(node)
    if time == 0:
        diagnostics.error(
            f"'{key}' must be at least 1 us; it is {text_of(node)}",
            span_of(node),
            "Write a longer time",
            id="MG-3004",
        )
    return time


def _executor(item: YamlNode, node: NodeDecl, diagnostics: Diagnostics) -> ExecutorDecl:
    handles = tuple(h for i in items(child(item, "handles")) if (h := named_of(i)) is not None)
    known = {t.name for t in node.timers} | {e.topic for e in node.endpoints if KIND[e.kind].waited}
    for handle in handles:
        if handle.name not in known:
            hint = nearest(handle.name, known) or (
                f"Available: {', '.join(sorted(known))}" if known else None
            )
            diagnostics.error(
                f"the node has no timer, subscription or service '{handle.name}'",
                handle.span,
                hint,
                id="MG-3010",
            )
    timeout = time_of(child(item, "timeout"))
    return ExecutorDecl(text_of(child(item, "name")) or "", handles, timeout, item.span)


def check_unique(
    kind: str,
    named: Sequence[tuple[str, Span | None]],
    diagnostics: Diagnostics,
    hint: str | None = None,
    longest: int | None = None,
) -> None:
    """Report names that come twice among things of one kind; `hint`: what to do, if not to take another name.

    `longest`: the most characters of a name.
    """
    seen: dict[str, Span | None] = {}
    for name, span in named:
        first = seen.get(name)
        if name in seen and name:
            where = f"; the first is in {_place(first, span)}" if first else ""
            words = hint or f"Write another name such as {_free_name(name, {n for n, _ in named}, longest)}"
            diagnostics.error(f"duplicate {kind} '{name}'{where}", span, words, id="MG-3011")
        seen.setdefault(name, span)


def _free_name(name: str, taken: set[str], longest: int | None) -> str:
    """Return the name with the first number from 2 on that makes it another one."""
    endings = (f"_{number}" for number in count(2))
    names = (name[: longest - len(ending) if longest else None] + ending for ending in endings)
    return next(free for free in names if free not in taken)


def _place(first: Span, span: Span | None) -> str:
    """Return the line of a place, with its file where that is not the file of `span`."""
    elsewhere = span is not None and first.source.name != span.source.name
    return f"{first.source.name}:{first.line}" if elsewhere else f"line {first.line}"
