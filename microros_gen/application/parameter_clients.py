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
ARRAYS = ("byte[]", "bool[]", "integer[]", "double[]", "string[]")


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
            f"the client of '{full}' only watches, and needs another operation",
            listed.span,
            "Write operations: [get, watch]",
            id="MG-3090",
        )
    settings = item if isinstance(item, MappingNode) else None
    parameters, string, elements = (child(settings, key) for key in ("parameters", "string", "elements"))
    description = child(settings, "description")
    default = ParameterClientDecl("")
    size = size_of(elements) or 0
    types = _types(child(settings, "types"), default.types, size)
    if settings is not None:
        _check_types(settings, full, types, size, diagnostics)
    return ParameterClientDecl(
        node=full,
        operations=operations or default.operations,
        parameters=int_of(parameters) or default.parameters,
        types=types,
        string=default.string if string is None else size_of(string) or 0,
        elements=size,
        description=default.description if description is None else size_of(description) or 0,
        span=item.span,
    )


def _types(listed: YamlNode | None, default: tuple[str, ...], elements: int) -> tuple[str, ...]:
    """Return what is listed; without a list strings, and with `elements` every array."""
    if listed is None:
        return (*default, *ARRAYS) if elements else default
    return tuple(text for part in items(listed) if (text := text_of(part)) is not None)


def _check_types(
    settings: MappingNode, full: str, types: tuple[str, ...], elements: int, diagnostics: Diagnostics
) -> None:
    """Report types without their size, and sizes without a type."""
    arrays = [kind for kind in types if kind in ARRAYS]
    listed, string = child(settings, "types"), child(settings, "string")
    if listed is None:
        return
    if arrays and not elements:
        message = f"the client of '{full}' has values of type {arrays[0]}, and its arrays have no size"
        hint = "Add the most elements that an array has: elements: 8"
        diagnostics.error(message, listed.span, hint, id="MG-3091")
    if elements and not arrays:
        message = f"the client of '{full}' has {elements} elements of an array, and no type in `types` is one"
        hint = "Add the type of the arrays, or remove `elements`"
        diagnostics.error(message, listed.span, hint, id="MG-3092")
    if string is not None and not {"string", "string[]"} & {*types}:
        message = f"the client of '{full}' has a size of strings, and no type in `types` is one"
        hint = "Add string, or remove `string`"
        diagnostics.error(message, string.span, hint, id="MG-3093")
