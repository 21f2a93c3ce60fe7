# SPDX-License-Identifier: Apache-2.0
"""`actions:` and `action_clients:` of a node → its action servers and clients."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypedDict

from microros_gen.application.action_decl import ActionClientDecl, ActionDecl
from microros_gen.application.limit_rule import LimitRule
from microros_gen.application.limits import endpoint_limits
from microros_gen.application.names import expand_topic_name, expanded_fault, substitute, topic_fault
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.tree_values import child, int_of, items, report_name, span_of, text_of, time_of
from microros_gen.documents.yaml_tree import YamlNode

LONGEST_PART = "/_action/cancel_goal"
"""The longest of what ROS 2 appends to the name of an action."""
US_PER_MS = 1000


def parse_actions(
    tree: YamlNode | None, node: str, namespace: str, diagnostics: Diagnostics
) -> Iterator[ActionDecl]:
    """Yield the declarations; faulty names and times are errors at their places."""
    default = ActionDecl("", "")
    for item in items(tree):
        yield ActionDecl(
            **_shared(item, node, namespace, diagnostics),
            goals=int_of(child(item, "goals")) or default.goals,
            result_timeout_ms=_timeout(item, "result_timeout", default.result_timeout_ms, diagnostics),
            waiting=int_of(child(item, "waiting")) or default.waiting,
        )


def parse_action_clients(
    tree: YamlNode | None, node: str, namespace: str, diagnostics: Diagnostics
) -> Iterator[ActionClientDecl]:
    """Yield the declarations, as above."""
    default = ActionClientDecl("", "")
    for item in items(tree):
        yield ActionClientDecl(
            **_shared(item, node, namespace, diagnostics),
            goals=int_of(child(item, "goals")) or default.goals,
            response_timeout_ms=_timeout(item, "response_timeout", default.response_timeout_ms, diagnostics),
            result_timeout_ms=_timeout(item, "result_timeout", default.result_timeout_ms, diagnostics),
        )


class _Shared(TypedDict):
    """What both declarations have."""

    name: str
    type: str
    span: Span | None
    type_span: Span | None
    limits: tuple[LimitRule, ...]


def _shared(item: YamlNode, node: str, namespace: str, diagnostics: Diagnostics) -> _Shared:
    kind = child(item, "type")
    return {
        "name": _name(item, node, namespace, diagnostics),
        "type": text_of(kind) or "",
        "span": item.span,
        "type_span": span_of(kind),
        "limits": endpoint_limits(child(item, "limits"), text_of(kind) or ""),
    }


def _name(item: YamlNode, node: str, namespace: str, diagnostics: Diagnostics) -> str:
    """Return the name of the action with {node} and {ns} replaced; a faulty or too long one is an error."""
    name = child(item, "name")
    if name is not None and report_name(name, "the action name", topic_fault, diagnostics):
        full = expand_topic_name(text_of(name) or "", node, namespace)
        fault = expanded_fault(full + LONGEST_PART)
        if fault:
            message = f"the service '{full[:40]}…{LONGEST_PART}' {fault.message}"
            diagnostics.error(message, name.span, fault.hint, id=fault.id)
    return substitute(text_of(name) or "", node, namespace)


def _timeout(item: YamlNode, key: str, default: int, diagnostics: Diagnostics) -> int:
    """Return the time in milliseconds; one that a counter of 32 bits cannot tell apart is an error."""
    node = child(item, key)
    time = time_of(node)
    if time is None:
        return default
    if not US_PER_MS <= time < US_PER_MS << 31:
        diagnostics.error(
            f"'{key}' must be at least 1 ms and less than 24 days; it is {text_of(node)}",
            span_of(node),
            "Write a time such as 10 s",
            id="MG-3094",
        )
    return time // US_PER_MS
