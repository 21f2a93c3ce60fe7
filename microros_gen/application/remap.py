# SPDX-License-Identifier: Apache-2.0
"""`remap:` of a node → its names on the wire, as ROS 2's remapping rules do at run time; sources keep theirs.

`__node` and `__ns` come first, so names that are not absolute follow them; a rule for a topic or service names what the
source says, and is taken once. Source: the ROS 2 design page "Remapping Names"; rcl/remap.h of ROS 2 Jazzy.
"""

from __future__ import annotations

from dataclasses import replace

from microros_gen.application.model import CLOCK_TOPIC, EndpointDecl, NodeDecl
from microros_gen.application.names import (
    absolute,
    expand_topic_name,
    expanded_fault,
    namespace_fault,
    node_name_fault,
    topic_fault,
)
from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.named import NameFault
from microros_gen.documents.tree_values import child, entries, report_name, text_of
from microros_gen.documents.yaml_tree import YamlNode
from microros_gen.records import dataclass

NODE, NAMESPACE = "__node", "__ns"


@dataclass(frozen=True)
class _Rule:
    """A topic or service as the source names it, what it becomes, both expanded, and where the rule stands."""

    source_name: str
    wire: str
    key: str
    span: Span


def rename_node(node: NodeDecl, tree: YamlNode | None, diagnostics: Diagnostics) -> NodeDecl:
    """Return the node with the name and namespace of `__node` and `__ns`; what the source passes is kept besides."""
    name, namespace = child(tree, NODE), child(tree, NAMESPACE)
    renamed = node
    if name is not None and report_name(name, "the node name", node_name_fault, diagnostics):
        renamed = replace(renamed, name=text_of(name) or "")
    if namespace is not None and report_name(namespace, "the namespace", namespace_fault, diagnostics):
        renamed = replace(renamed, namespace=absolute(text_of(namespace) or "/"))
    if renamed == node:
        return node
    return replace(renamed, given_name=node.name, given_namespace=node.namespace)


def rename_endpoints(node: NodeDecl, tree: YamlNode | None, diagnostics: Diagnostics) -> NodeDecl:
    """Return the node with the topics and services that its rules give; a rule without effect is an error.

    One for /clock is kept: whether a node subscribes to it is not known yet.
    """
    rules = _rules(node, tree, diagnostics)
    known = {expand_topic_name(e.topic, node.name, node.namespace): e.topic for e in node.endpoints}
    for rule in rules.values():
        if rule.source_name == CLOCK_TOPIC and rule.source_name not in known:
            node = replace(node, clock_topic=rule.wire, clock_span=rule.span)
        elif rule.source_name not in known:
            hint = nearest(rule.key, known.values()) or (
                f"Available: {', '.join(known.values())}" if known else "Declare it first"
            )
            diagnostics.error(
                f"the node has no topic or service '{rule.key}' to remap", rule.span, hint, id="MG-3027"
            )
    return replace(node, endpoints=tuple(_renamed(e, node, rules) for e in node.endpoints))


def _rule_fault(name: str) -> NameFault | None:
    if "{" in name:
        return NameFault(
            "has a substitution, which a remap rule cannot have",
            name.index("{"),
            "Write ~ or the name",
            id="MG-3051",
        )
    return topic_fault(name)


def _renamed(endpoint: EndpointDecl, node: NodeDecl, rules: dict[str, _Rule]) -> EndpointDecl:
    source_name = expand_topic_name(endpoint.topic, node.name, node.namespace)
    rule = rules.get(source_name)
    return replace(endpoint, topic=rule.wire, declared_as=source_name) if rule else endpoint


def _rules(node: NodeDecl, tree: YamlNode | None, diagnostics: Diagnostics) -> dict[str, _Rule]:
    found: dict[str, _Rule] = {}
    for entry in entries(tree):
        if entry.key in (NODE, NAMESPACE):
            continue
        fault = _rule_fault(entry.key)
        if fault:
            diagnostics.error(
                f"the name '{entry.key}' {fault.message}", entry.key_span, fault.hint, id=fault.id
            )
            continue
        if not report_name(entry.value, "the name", _rule_fault, diagnostics):
            continue
        source_name = expand_topic_name(entry.key, node.name, node.namespace)
        wire = expand_topic_name(text_of(entry.value) or "", node.name, node.namespace)
        long = expanded_fault(wire)
        if long:
            diagnostics.error(
                f"the name '{wire[:60]}' {long.message}", entry.value.span, long.hint, id="MG-3029"
            )
        elif source_name in found:
            first = found[source_name].key
            message = f"'{entry.key}' and '{first}' are the same name, '{source_name}': it is remapped twice"
            diagnostics.error(message, entry.key_span, "Remove one of the rules", id="MG-3030")
        else:
            found[source_name] = _Rule(source_name, wire, entry.key, entry.key_span)
    return found
