# SPDX-License-Identifier: Apache-2.0
"""`parameter_clients:` of a node → the other nodes whose parameters it gets, sets, lists or watches."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.model import ParameterClientDecl
from microros_gen.application.names import expand_topic_name, expanded_fault, topic_fault
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.tree_values import child, int_of, items, report_name, size_of, text_of
from microros_gen.documents.yaml_tree import MappingNode, YamlNode

_LONGEST_SERVICE = "/set_parameters_atomically"


def parse_parameter_clients(
    tree: YamlNode | None, node: str, namespace: str, diagnostics: Diagnostics
) -> Iterator[ParameterClientDecl]:
    """Yield the declarations; a text is short for `{node: text}`. A name without a slash is in `namespace`."""
    for item in items(tree):
        declared = child(item, "node") if isinstance(item, MappingNode) else item
        full = ""
        if declared is not None and report_name(declared, "the node", topic_fault, diagnostics):
            full = expand_topic_name(text_of(declared) or "", node, namespace)
            fault = expanded_fault(full + _LONGEST_SERVICE)
            if fault:
                message = f"the service '{full[:40]}…{_LONGEST_SERVICE}' {fault.message}"
                diagnostics.error(message, declared.span, fault.hint, id=fault.id)
        yield _client(item, full, diagnostics)


def _client(item: YamlNode, full: str, diagnostics: Diagnostics) -> ParameterClientDecl:
    listed = child(item, "operations") if isinstance(item, MappingNode) else None
    operations = tuple(text for part in items(listed) if (text := text_of(part)) is not None)
    if listed is not None and operations == ("watch",):
        diagnostics.error(
            f"the client of '{full}' calls nothing: an executor runs it for a call",
            listed.span,
            "Write operations: [get, watch]",
            id="MG-3090",
        )
    settings = item if isinstance(item, MappingNode) else None
    parameters, string, elements = (child(settings, key) for key in ("parameters", "string", "elements"))
    default = ParameterClientDecl("")
    return ParameterClientDecl(
        node=full,
        operations=operations or default.operations,
        parameters=int_of(parameters) or default.parameters,
        string=default.string if string is None else size_of(string) or 0,
        elements=size_of(elements) or 0,
        span=item.span,
    )
