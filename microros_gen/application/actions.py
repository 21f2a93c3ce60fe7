# SPDX-License-Identifier: Apache-2.0
"""`actions:` of a node → its action servers."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.action_decl import ActionDecl
from microros_gen.application.names import expand_topic_name, expanded_fault, substitute, topic_fault
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.tree_values import child, int_of, items, report_name, span_of, text_of, time_of
from microros_gen.documents.yaml_tree import YamlNode

LONGEST_PART = "/_action/cancel_goal"
"""The longest of what ROS 2 appends to the name of an action."""
US_PER_MS = 1000


def parse_actions(
    tree: YamlNode | None, node: str, namespace: str, diagnostics: Diagnostics
) -> Iterator[ActionDecl]:
    """Yield the declarations; faulty names and times are errors at their places."""
    for item in items(tree):
        name, kind = child(item, "name"), child(item, "type")
        if name is not None and report_name(name, "the action name", topic_fault, diagnostics):
            full = expand_topic_name(text_of(name) or "", node, namespace)
            fault = expanded_fault(full + LONGEST_PART)
            if fault:
                message = f"the service '{full[:40]}…{LONGEST_PART}' {fault.message}"
                diagnostics.error(message, name.span, fault.hint, id=fault.id)
        default = ActionDecl("", "")
        yield ActionDecl(
            name=substitute(text_of(name) or "", node, namespace),
            type=text_of(kind) or "",
            goals=int_of(child(item, "goals")) or default.goals,
            result_timeout_ms=_timeout(child(item, "result_timeout"), diagnostics),
            waiting=int_of(child(item, "waiting")) or default.waiting,
            span=item.span,
            type_span=span_of(kind),
        )


def _timeout(node: YamlNode | None, diagnostics: Diagnostics) -> int:
    """Return the time in milliseconds; one that a counter of 32 bits cannot tell apart is an error."""
    time = time_of(node)
    if time is None:
        return ActionDecl.result_timeout_ms
    if not US_PER_MS <= time < US_PER_MS << 31:
        diagnostics.error(
            f"'result_timeout' must be at least 1 ms and less than 24 days; it is {text_of(node)}",
            span_of(node),
            "Write a time such as 10 s",
            id="MG-3094",
        )
    return time // US_PER_MS
