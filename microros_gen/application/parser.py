# SPDX-License-Identifier: Apache-2.0
"""The application file (`microros.yaml`) → Application."""

from __future__ import annotations

import re
from pathlib import Path
from types import MappingProxyType

from microros_gen.application import diagnosis_decl, task_decl, time_source, watchdog
from microros_gen.application.agent_places import (
    Places,
    are_devices,
    parse_agent_address,
    parse_agent_devices,
    parse_agents,
    parse_discover,
)
from microros_gen.application.diagnosis import parse_diagnosis
from microros_gen.application.limits import application_limits, endpoint_limits
from microros_gen.application.log_decl import BUFFERED_LOG_WRITERS, LogWriter
from microros_gen.application.model import (
    LARGEST_UDP_PAYLOAD,
    Application,
    EndpointChange,
    Memory,
    TargetRef,
    component_change,
)
from microros_gen.application.nodes import parse_nodes
from microros_gen.application.session_times import hard_liveliness, session_times
from microros_gen.application.system_decl import SystemRef
from microros_gen.application.tasks import parse_tasks
from microros_gen.application.transport_decl import Transport
from microros_gen.diagnostics import Diagnostics, Source, Span, reads
from microros_gen.documents.named import Named
from microros_gen.documents.schema import load_schema, validate
from microros_gen.documents.tree_values import (
    bool_of,
    child,
    entries,
    int_of,
    items,
    named_of,
    size_of,
    span_of,
    text_of,
)
from microros_gen.documents.yaml_tree import Entry, MappingNode, ScalarNode, YamlNode, parse_yaml

SCHEMA = Path(__file__).with_name("application.schema.json")
LONGEST_BLOCK_MS = 60_000
"""Longest time that `on_full: block …` may take, milliseconds."""
_BLOCK = re.compile(r"block ([0-9]{1,12}) ?(ms|s)")
_POOLS_BESIDE_NODES = (
    "history",
    "input_history",
    "best_effort_history",
    "slot_size",
    "timers",
    "executors",
    "handles",
    "guard_conditions",
    "wait_sets",
    "ros_clocks",
    "jump_callbacks",
    "parameters",
    "loggers",
    "logger_name_size",
)
_WITHOUT_ADDRESS = ("serial", "canfd", "custom")
_ONLY_FOR = {
    "device": ("serial", "canfd"),
    "id": ("canfd",),
    "bitrate": ("canfd",),
    "baud": ("serial",),
    "send_buffer": ("serial",),
    "framing": ("custom",),
    "read_polls": ("custom",),
    "mtu": ("udp", "tcp", "serial", "custom"),
    "seal": ("udp", "tcp", "serial"),
}


@reads
def parse_application(source: Source, diagnostics: Diagnostics) -> Application | None:
    """Return the application that `source` describes; None where `diagnostics` got errors from it.

    Every fault is reported in one run: what the schema refuses, and what is wrong with names, addresses and
    times.
    """
    found = Diagnostics()
    tree = parse_yaml(source, found)
    if tree is not None or not found.has_errors():
        validate(tree, source, load_schema(SCHEMA), found)
    application = _application(tree, found) if isinstance(tree, MappingNode) else None
    diagnostics.extend(sorted(found, key=lambda d: (d.span.line, d.span.column) if d.span else (0, 0)))
    return None if found.has_errors() else application


def _application(tree: MappingNode, diagnostics: Diagnostics) -> Application:
    default = Application()
    nodes = parse_nodes(child(tree, "nodes"), diagnostics)
    tasks = parse_tasks(child(tree, task_decl.KEY), nodes, diagnostics)
    pools = {e.key: n for e in entries(child(tree, "pools")) if (n := int_of(e.value)) is not None}
    if nodes:
        _check_pools(child(tree, "pools"), diagnostics)
    on_full, block_ms = _on_full(child(tree, "on_full"), diagnostics)
    return Application(
        distro=text_of(child(tree, "distro")) or default.distro,
        profiles=_names(child(tree, "profiles")),
        components=tuple(component_change(c.name, c.span) for c in _names(child(tree, "components"))),
        entities=named_of(child(tree, "entities")),
        creation=named_of(child(tree, "creation")),
        liveliness=named_of(child(tree, "liveliness")),
        transport=_transport(child(tree, "transport"), diagnostics),
        session_key=_session_key(child(child(tree, "session"), "key")),
        hard_liveliness_ms=hard_liveliness(child(tree, "session"), diagnostics),
        times=session_times(child(tree, "session"), diagnostics),
        target=_target(child(tree, "target")),
        nodes=nodes,
        interfaces=_names(child(tree, "interfaces")),
        interface_paths=_names(child(tree, "interface_paths")),
        pools=MappingProxyType(pools),
        limits=application_limits(child(tree, "limits")),
        endpoints=tuple(_endpoint_change(e) for e in entries(child(tree, "endpoints"))),
        memory=_memory(child(tree, "memory")),
        on_full=on_full,
        on_full_block_ms=block_ms,
        error_text=text_of(child(tree, "errors")) != "code",
        exact_float64=text_of(child(tree, "float64")) == "exact",
        clock=named_of(child(tree, "clock")),
        logging=_log_writers(child(tree, "logging"), diagnostics),
        diagnosis=parse_diagnosis(child(tree, diagnosis_decl.KEY), nodes, diagnostics),
        time_source=time_source.parse_time_source(child(tree, time_source.KEY), diagnostics),
        system=_system(child(tree, "system")),
        tasks=tasks,
        watchdog=watchdog.parse_watchdog(child(tree, watchdog.KEY), tasks, diagnostics),
        spans=MappingProxyType(_spans(tree)),
    )


def _log_writers(node: YamlNode | None, diagnostics: Diagnostics) -> tuple[LogWriter, ...]:
    found: dict[str, LogWriter] = {}
    for item in items(node) or ((node,) if node is not None else ()):
        writer = LogWriter(
            to=text_of(item) or text_of(child(item, "to")) or "",
            level=text_of(child(item, "level")) or LogWriter.level,
            span=item.span,
            size=size_of(child(item, "size")),
        )
        if writer.size is not None and writer.to not in BUFFERED_LOG_WRITERS:
            message = f"the log writer '{writer.to}' keeps no lines, so it has no size"
            diagnostics.error(message, item.span, "Remove `size`", id="MG-3053")
        if writer.to in found:
            message = f"duplicate writer '{writer.to}' in 'logging'"
            diagnostics.error(message, item.span, "Write it once, with its lowest level", id="MG-3052")
        found.setdefault(writer.to, writer)
    return tuple(found.values())


def _system(node: YamlNode | None) -> SystemRef | None:
    file, board = named_of(child(node, "file")), named_of(child(node, "board"))
    return SystemRef(file, board) if file is not None and board is not None else None


def _endpoint_change(entry: Entry) -> EndpointChange:
    return EndpointChange(
        name=entry.key,
        depth=int_of(child(entry.value, "depth")),
        queue=int_of(child(entry.value, "queue")),
        limits=endpoint_limits(child(entry.value, "limits"), ""),
        span=entry.key_span,
    )


def _check_pools(node: YamlNode | None, diagnostics: Diagnostics) -> None:
    for entry in entries(node):
        if entry.key not in _POOLS_BESIDE_NODES:
            message = f"'pools.{entry.key}' has no effect: `nodes` decides what is created"
            diagnostics.warning(message, entry.key_span, "Remove it", id="MG-3012")


def _names(node: YamlNode | None) -> tuple[Named, ...]:
    return tuple(named for item in items(node) if (named := named_of(item)) is not None)


def _spans(tree: MappingNode) -> dict[str, Span]:
    spans = {entry.key: entry.key_span for entry in tree}
    for owner in ("pools", "memory", "session", "transport"):
        spans |= {f"{owner}.{entry.key}": entry.key_span for entry in entries(child(tree, owner))}
    return spans


def _transport(node: YamlNode | None, diagnostics: Diagnostics) -> Transport:
    if node is None:
        return Transport()
    kind, agent, mtu = child(node, "type"), child(node, "agent"), child(node, "mtu")
    type_name = text_of(kind) or Transport().type
    discover = parse_discover(text_of(agent) or "", span_of(agent), diagnostics)
    address = None if discover is not None else _agent(agent, diagnostics)
    listed, listed_at = _agents(node, diagnostics), span_of(child(node, "agents"))
    devices = parse_agent_devices(listed, listed_at, diagnostics) if are_devices(listed) else ()
    agents = () if devices else parse_agents(listed, listed_at, diagnostics)
    host, port = address or next(iter(agents), (Transport().host, Transport().port))
    if agent is not None and type_name in _WITHOUT_ADDRESS:
        message = f"transport: {type_name} has no agent address"
        diagnostics.error(message, agent.span, "Remove `agent`, or use type: udp or tcp", id="MG-3013")
    for key, only in _ONLY_FOR.items():
        if child(node, key) is not None and type_name not in only:
            message = f"transport: {type_name} has no `{key}`"
            hint = f"Remove `{key}`, or use type: {' or '.join(only)}"
            diagnostics.error(message, span_of(child(node, key)), hint, id="MG-3014")
    framing, read_polls, device = (child(node, key) for key in ("framing", "read_polls", "device"))
    if bool_of(framing) and read_polls is not None:
        message = "'transport.read_polls' has no effect with frames: their read function always gets a time-out of 0"
        diagnostics.error(
            message, read_polls.span, "Remove `read_polls`, or set framing: false", id="MG-3015"
        )
    size = int_of(mtu)
    if size is not None and type_name == "udp" and size > LARGEST_UDP_PAYLOAD:
        message = f"'transport.mtu' is {size}; a UDP datagram holds {LARGEST_UDP_PAYLOAD}"
        diagnostics.error(message, span_of(mtu), f"Set mtu: {LARGEST_UDP_PAYLOAD} or less", id="MG-3016")
    return Transport(
        type=type_name,
        host=host,
        port=port,
        mtu=size,
        span=node.span,
        mtu_span=span_of(mtu),
        type_span=span_of(kind),
        agent_span=span_of(agent) or listed_at,
        agents=agents,
        devices=devices,
        device=next(iter(devices), text_of(device) if type_name == "serial" else None) or Transport().device,
        can_device=text_of(device) or Transport().can_device
        if type_name == "canfd"
        else Transport().can_device,
        can_id=int_of(child(node, "id")),
        bitrate=int_of(child(node, "bitrate")),
        seal=text_of(child(node, "seal")) or "",
        baud=int_of(child(node, "baud")) or Transport().baud,
        framing=bool_of(framing),
        read_polls=bool_of(read_polls) or False,
        discover=discover,
        send_buffer=int_of(child(node, "send_buffer")),
    )


def _agent(node: YamlNode | None, diagnostics: Diagnostics) -> tuple[str, int] | None:
    """Return host and port; a host name and a missing or wrong port are errors."""
    text = text_of(node)
    return None if text is None else parse_agent_address(text, span_of(node), diagnostics)


def _agents(transport: YamlNode, diagnostics: Diagnostics) -> Places:
    """Return the entries of the list of agents, none without a list; it stands in place of the one agent."""
    node = child(transport, "agents")
    for key in ("agent", "device"):
        if node is not None and child(transport, key) is not None:
            message = f"'transport.{key}' and 'transport.agents' contradict each other"
            hint = f"Remove `{key}`: the first of the list is tried first"
            diagnostics.error(message, node.span, hint, id="MG-3180")
    return [(text, item.span) for item in items(node) if (text := text_of(item)) is not None]


def _session_key(node: YamlNode | None) -> int | str | None:
    number = int_of(node)
    return number if number is not None else text_of(node)


def _target(node: YamlNode | None) -> TargetRef:
    if isinstance(node, ScalarNode):
        return TargetRef(text_of(node) or TargetRef().name, span=node.span)
    name, parts = child(node, "name"), [child(node, key) for key in ("rtos", "network")]
    rtos, network = (Named(text_of(p) or "", p.span) if p is not None else None for p in parts)
    return TargetRef(text_of(name) or TargetRef().name, rtos, network, span_of(name))


def _memory(node: YamlNode | None) -> Memory:
    parts = {key: child(node, key) for key in ("arena", "ram_budget", "flash_budget", "stack")}
    return Memory(
        arena=size_of(parts["arena"]) or 0,
        messages=int_of(child(node, "messages")),
        ram_budget=size_of(parts["ram_budget"]),
        flash_budget=size_of(parts["flash_budget"]),
        stack=size_of(parts["stack"]),
        ram_span=span_of(parts["ram_budget"]),
        flash_span=span_of(parts["flash_budget"]),
        arena_span=span_of(parts["arena"]),
        stack_span=span_of(parts["stack"]),
    )


def _on_full(node: YamlNode | None, diagnostics: Diagnostics) -> tuple[str, int]:
    text = text_of(node) or "error"
    match = _BLOCK.fullmatch(text)
    if match is None:
        return text, 0
    milliseconds = int(match.group(1)) * (1000 if match.group(2) == "s" else 1)
    if not 1 <= milliseconds <= LONGEST_BLOCK_MS:
        message = f"'on_full: {text}' must block between 1 ms and {LONGEST_BLOCK_MS // 1000} s"
        diagnostics.error(message, span_of(node), "`on_full: error` does not block at all", id="MG-3025")
    return "block", milliseconds
