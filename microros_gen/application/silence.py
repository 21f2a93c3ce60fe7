# SPDX-License-Identifier: Apache-2.0
"""`on_silence:` of a subscription → what is called when no sample arrives."""

from __future__ import annotations

from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.tree_values import child, span_of, text_of, time_of
from microros_gen.documents.yaml_tree import YamlNode
from microros_gen.interfaces.msg.names import C_KEYWORDS
from microros_gen.records import dataclass

KEY = "on_silence"
"""Its key in the application file."""
AFTER_US = (1_000, 86_400_000_000)
"""Shortest and longest silence, microseconds."""
_TAKEN = C_KEYWORDS | {"bool", "false", "main", "true"}
_OF_LIBRARY = ("cdr_", "rcl_", "rclc_", "rcutils_", "rmw_", "rosidl_", "ucdr_", "uxr_", "xrce_")
"""The program's function is declared by this name, and could not be compiled beside the library's of the same name."""


@dataclass(frozen=True)
class SilenceDecl:
    """The C function `call` is called once after `after_ms` without a sample."""

    after_ms: int
    call: str
    span: Span | None = None


def parse_silence(tree: YamlNode | None, elsewhere: str, diagnostics: Diagnostics) -> SilenceDecl | None:
    """Return what is below `on_silence:`; None: nothing.

    `elsewhere`: the key, with its value, by which messages come without an agent; empty: they do not.
    """
    if tree is None:
        return None
    after_node, call_node = child(tree, "after"), child(tree, "call")
    after, call = time_of(after_node), text_of(call_node) or ""
    if after is not None and not AFTER_US[0] <= after <= AFTER_US[1]:
        message = f"'after' of on_silence is {text_of(after_node)}; it must be 1 ms to 86400 s"
        diagnostics.error(message, span_of(after_node), "Write after: 500 ms", id="MG-3212")
    if call in _TAKEN or call.startswith(_OF_LIBRARY):
        message = f"'{call}' is no name of a function of the application"
        diagnostics.error(message, span_of(call_node), "Write call: stop_motors", id="MG-3213")
    if elsewhere:
        message = f"on_silence looks at what the agent delivers, and {elsewhere} delivers without it"
        diagnostics.error(message, tree.span, f"Remove on_silence, or {elsewhere}", id="MG-3214")
    return SilenceDecl((after or 0) // 1000, call, tree.span)
