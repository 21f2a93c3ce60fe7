# SPDX-License-Identifier: Apache-2.0
"""Parser of the agent's configuration file (`microros-gen agent --config`). Every fault is reported with its position.

The structure is defined by agent.schema.json, which editors use as well.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from microros_gen.agent.configuration.model import (
    AgentFile,
    CanChoice,
    NamedPath,
    PtyChoice,
    SerialChoice,
    SocketChoice,
    TransportChoice,
)
from microros_gen.agent.workers.count import worker_count
from microros_gen.diagnostics import Diagnostics, Source, reads
from microros_gen.documents.schema import load_schema, validate
from microros_gen.documents.tree_values import (
    bool_of,
    child,
    entries,
    int_of,
    items,
    number_of,
    span_of,
    text_of,
)
from microros_gen.documents.yaml_tree import ScalarNode, YamlNode, parse_yaml

SCHEMA = Path(__file__).with_name("agent.schema.json")
DISCOVERY_PORT = 7400
_TCP_LIMITS = ("connections", "connections_per_host", "output_bytes", "patience_s")


@reads
def parse_agent_file(source: Source, diagnostics: Diagnostics) -> AgentFile:
    """Return the contents of the file; report faults to `diagnostics` and then return an empty AgentFile."""
    found = Diagnostics()
    tree = parse_yaml(source, found)
    if not found.has_errors():
        validate(tree, source, load_schema(SCHEMA), found)
    diagnostics.extend(found)
    if tree is None or found.has_errors():
        return AgentFile()
    log = child(tree, "log")
    return AgentFile(
        transports=tuple(t for item in items(child(tree, "transports")) for t in _transports(item)),
        discovery=_discovery(child(tree, "discovery")),
        domain=int_of(child(tree, "domain")),
        graph_server=bool_of(child(tree, "graph_server")) or False,
        client_state=bool_of(child(tree, "client_state")) or False,
        diagnostics=bool_of(child(tree, "diagnostics")) or False,
        status_socket=text_of(child(tree, "status_socket")),
        metrics=_place(child(tree, "metrics")),
        page=_place(child(tree, "page")),
        parameter_server=bool_of(child(tree, "parameter_server")) is not False,
        parameter_file=text_of(child(tree, "parameter_file")),
        limits=_numbers(child(tree, "limits")),
        workers=_workers(child(tree, "workers")),
        references=_paths(child(tree, "references")),
        entities=_paths(child(tree, "entities")),
        policy=_path(child(tree, "policy")),
        psk_file=_path(child(tree, "psk_file")),
        manifests=_paths(child(tree, "manifests")),
        interface_paths=_paths(child(tree, "interface_paths")),
        record=_path(child(tree, "record")),
        log_format=text_of(child(log, "format")),
        verbose=int_of(child(log, "verbose")),
    )


def _transports(item: YamlNode) -> list[TransportChoice]:
    return [replace(_transport(e.key, e.value), span=e.key_span) for e in entries(item)]


def _transport(kind: str, node: YamlNode) -> TransportChoice:
    if kind == "serial":
        baud = int_of(child(node, "baud"))
        return SerialChoice(text_of(child(node, "device")) or "", SerialChoice.baud if baud is None else baud)
    if kind == "canfd":
        return CanChoice(text_of(child(node, "device")) or "")
    if kind == "pty":
        speed = int_of(child(node, "baud"))
        return PtyChoice(text_of(child(node, "link")), PtyChoice.baud if speed is None else speed)
    port = int_of(child(node, "port"))
    limits = tuple((key, value) for key, value in _numbers(node) if key in _TCP_LIMITS)
    return SocketChoice(
        kind, SocketChoice.port if port is None else port, text_of(child(node, "bind")), limits
    )


def _discovery(node: YamlNode | None) -> int | None:
    if bool_of(node) is not None:
        return DISCOVERY_PORT if bool_of(node) else None
    port = int_of(child(node, "port"))
    return DISCOVERY_PORT if node is not None and port is None else port


def _place(node: YamlNode | None) -> NamedPath | None:
    return (
        None
        if node is None
        else NamedPath(str(node.text) if isinstance(node, ScalarNode) else "", span_of(node))
    )


def _workers(node: YamlNode | None) -> int | None:
    return worker_count(str(node.text)) if isinstance(node, ScalarNode) else None


def _numbers(node: YamlNode | None) -> tuple[tuple[str, float], ...]:
    return tuple((e.key, value) for e in entries(node) if (value := number_of(e.value)) is not None)


def _path(node: YamlNode | None) -> NamedPath | None:
    text = text_of(node)
    return None if text is None else NamedPath(text, span_of(node))


def _paths(node: YamlNode | None) -> tuple[NamedPath, ...]:
    return tuple(NamedPath(text_of(item) or "", span_of(item)) for item in items(node))
