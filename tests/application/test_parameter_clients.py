# SPDX-License-Identifier: Apache-2.0
"""`parameter_clients:` of a node: what is declared, and what it can get wrong."""

from __future__ import annotations

import pytest

from microros_gen.application.model import ParameterClientDecl
from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source
from tests.support.ids import without_id

NODE = "nodes:\n  - name: device\n    namespace: /arm\n    parameter_clients: "


def parse(clients: str) -> tuple[tuple[ParameterClientDecl, ...], list[str]]:
    found = Diagnostics()
    application = parse_application(Source("f", f"{NODE}{clients}\n"), found)
    nodes = application.nodes if application else ()
    return (nodes[0].parameter_clients if nodes else ()), [without_id(d.headline()) for d in found]


def test_a_text_is_short_for_the_node() -> None:
    clients, errors = parse(
        "[/motor, wheel, {node: ~/child, operations: [get, watch], string: 0, elements: 7}]"
    )
    assert errors == []
    first, second, third = clients
    assert (first.node, first.operations) == ("/motor", ("get", "set"))
    assert (first.parameters, first.string, first.elements) == (4, 49, 0)
    assert second.node == "/arm/wheel"
    assert (third.node, third.operations) == ("/arm/device/child", ("get", "watch"))
    assert (third.string, third.elements) == (0, 7)


def test_types_of_values() -> None:
    clients, errors = parse(
        "[{node: /a, elements: 3}, {node: /b, types: ['double[]'], elements: 5}, {node: /c, types: []}, /d]"
    )
    assert errors == []
    every = ("string", "byte[]", "bool[]", "integer[]", "double[]", "string[]")
    assert [client.types for client in clients] == [every, ("double[]",), (), ("string",)]
    (client,), _ = parse("[{node: /a, operations: [describe, get_types], description: 20}]")
    assert (client.operations, client.description) == (("describe", "get_types"), 20)


ERRORS = {
    "twice": ("[/motor, {node: /motor}]", "duplicate parameter client '/motor'; the first is in line 4"),
    "no node": ("[{operations: [get]}]", "missing key 'node'"),
    "no name": ("['']", "the node '' is empty"),
    "a character": ("[/mo-tor]", "the node '/mo-tor' has the character '-'"),
    "a slash too many": ("[/motor/]", "the node '/motor/' ends with a slash"),
    "a long name": (f"[/{'n' * 230}]", "is 257 characters long"),
    "an unknown operation": ("[{node: /motor, operations: [gets]}]", "Did you mean 'get'?"),
    "no operation": ("[{node: /motor, operations: []}]", "operations"),
    "an operation twice": ("[{node: /motor, operations: [get, get]}]", "operations"),
    "watch alone": (
        "[{node: /motor, operations: [watch]}]",
        "the client of '/motor' only watches, and needs another operation. Write operations: [get, watch]",
    ),
    "no parameter": ("[{node: /motor, parameters: 0}]", "parameters"),
    "a string of less than nothing": ("[{node: /motor, string: -1}]", "string"),
    "arrays without a size": (
        "[{node: /motor, types: [string, 'bool[]']}]",
        "the client of '/motor' has values of type bool[], and its arrays have no size. "
        "Add the most elements that an array has: elements: 8",
    ),
    "a size without arrays": (
        "[{node: /motor, types: [string], elements: 8}]",
        "the client of '/motor' has 8 elements of an array, and no type in `types` is one",
    ),
    "a size without strings": (
        "[{node: /motor, types: ['double[]'], elements: 8, string: 9}]",
        "the client of '/motor' has a size of strings, and no type in `types` is one",
    ),
    "an unknown type": ("[{node: /motor, types: ['int[]']}]", "types"),
    "a type twice": ("[{node: /motor, types: [string, string]}]", "types"),
    "an unknown key": ("[{node: /motor, element: 3}]", "Did you mean 'elements'?"),
}


@pytest.mark.parametrize("case", ERRORS)
def test_errors_with_their_place(case: str) -> None:
    text, expected = ERRORS[case]
    _, errors = parse(text)
    assert len(errors) == 1
    assert errors[0].startswith("f:4:")
    assert expected in errors[0]
