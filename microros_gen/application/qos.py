# SPDX-License-Identifier: Apache-2.0
"""`qos:` of an endpoint → quality of service, as far as XRCE carries it (DDS-XRCE 1.0, annex A, EndpointQosBinary)."""

from __future__ import annotations

from microros_gen.application.model import Qos
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.tree_values import child, int_of, span_of, text_of, time_of
from microros_gen.documents.yaml_tree import YamlNode

_LONGEST_MS = 4_294_966_000
"""Longest deadline or lifespan: milliseconds in 32 bits, in whole seconds less one."""


def endpoint_qos(node: YamlNode | None, diagnostics: Diagnostics) -> Qos:
    """Return the quality of service below `qos:`; a time that cannot be carried is an error."""
    default = Qos()
    return Qos(
        reliability=text_of(child(node, "reliability")) or default.reliability,
        durability=text_of(child(node, "durability")) or default.durability,
        history=text_of(child(node, "history")) or default.history,
        depth=int_of(child(node, "depth")) or default.depth,
        span=span_of(node),
        deadline_ms=_milliseconds(node, "deadline", diagnostics),
        lifespan_ms=_milliseconds(node, "lifespan", diagnostics),
    )


def _milliseconds(node: YamlNode | None, key: str, diagnostics: Diagnostics) -> int:
    value = child(node, key)
    time = time_of(value)
    if time is None:
        return 0
    if time % 1000 or not 0 < time // 1000 <= _LONGEST_MS:
        diagnostics.error(
            f"XRCE carries a {key} in whole milliseconds, up to {_LONGEST_MS // 1000} s; it is {text_of(value)}",
            span_of(value),
            "Round it up",
            id="MG-3026",
        )
    return time // 1000
