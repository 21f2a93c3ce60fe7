# SPDX-License-Identifier: Apache-2.0
"""Parts that the application file chooses instead of those of its target: `rtos` and `network`."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.documents.files import read_text
from microros_gen.documents.named import Named
from microros_gen.documents.tree_values import entries, items, text_of
from microros_gen.documents.yaml_tree import Entry, MappingNode, ScalarNode, parse_yaml
from microros_gen.platform.target_file import merge_target

RTOS_FILE = Path(__file__).with_name("rtos.yaml")
NETWORKS_FILE = Path(__file__).with_name("networks.yaml")
NO_PARTS: Mapping[str, Named | None] = MappingProxyType({})


@cache
def rtos_names() -> Mapping[str, str]:
    """Return the part of each value of `rtos` that is no name of a part."""
    tree = parse_yaml(Source(RTOS_FILE.name, read_text(RTOS_FILE)), Diagnostics())
    return {entry.key: text_of(entry.value) or "" for entry in entries(tree)}


@cache
def networks() -> Mapping[str, tuple[str, ...]]:
    """Return the systems that each built-in network runs under."""
    tree = parse_yaml(Source(NETWORKS_FILE.name, read_text(NETWORKS_FILE)), Diagnostics())
    return {entry.key: tuple(text_of(item) or "" for item in items(entry.value)) for entry in entries(tree)}


def with_parts(node: MappingNode, parts: Mapping[str, Named | None], diagnostics: Diagnostics) -> MappingNode:
    """Lay `parts`, by their kind, over the parts of a (merged) target. A path is relative to the file of its span.

    An error in `diagnostics` for a target without an operating system and without a processor.
    """
    chosen = {}
    for kind, named in parts.items():
        if named is None or named.span is None:
            continue
        name = rtos_names().get(named.name, named.name) if kind == "os" else named.name
        if name != named.name and "cpu" not in node.entries:
            _refuse(node, named.name, named.span, diagnostics)
        chosen[kind] = Entry(kind, named.span, ScalarNode(name, name, True, named.span))
    merged = merge_target(MappingNode(chosen, node.span), node)
    if "os" in chosen and "network" in chosen:
        _check_network(merged, [entry.key_span for entry in chosen.values()][-1], diagnostics)
    return merged


def _check_network(node: MappingNode, span: Span, diagnostics: Diagnostics) -> None:
    """Refuse a built-in network whose functions call another built-in system than the one chosen with it.

    A network that is chosen alone may be for the system of a package, which replaces that of the target.
    """
    network, os = text_of(node.get("network")) or "", text_of(node.get("os")) or ""
    known = {system for systems in networks().values() for system in systems}
    if os in known and os not in networks().get(network, (os,)):
        message = (
            f"the network {network} does not run under {os}, but under {' or '.join(networks()[network])}"
        )
        fitting = " or ".join(f"`network: {name}`" for name, systems in networks().items() if os in systems)
        diagnostics.error(message, span, f"Write {fitting} below `target:`", id="MG-9866")


def _refuse(node: MappingNode, name: str, span: Span, diagnostics: Diagnostics) -> None:
    message = (
        f"the target {text_of(node.get('target'))} cannot do without an operating system: it has no `cpu`"
    )
    hint = f"Remove `rtos: {name}`, or name the target of a board"
    diagnostics.error(message, span, hint, id="MG-6200")
