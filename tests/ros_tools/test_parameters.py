# SPDX-License-Identifier: Apache-2.0
"""Parameter files: what is dumped is loaded as the same parameters."""

from __future__ import annotations

import pytest

from microros_gen.diagnostics import Source, UserError
from microros_gen.parameter_server.values import DOUBLE, INTEGER, STRING, ParameterValue
from microros_gen.ros_tools.parameters import dumped, parameters_of_file, value_from_text
from microros_gen.ros_tools.texts import dump


@pytest.mark.parametrize(
    "names",
    [
        ("a", "b.c", "b.d.e"),
        ("a", "a.b", "b"),
        ("a", "a.b", "a.b.c"),
        ("a.b", "a.b.c", "a.c"),
    ],
)
def test_dumped_parameters_are_loaded_as_the_same(names: tuple[str, ...]) -> None:
    values = {name: ParameterValue(INTEGER, i) for i, name in enumerate(names)}
    text = dump(dumped("/ns/arm", values.items()))
    assert dict(parameters_of_file(Source("x.yaml", text), "/ns/arm", True)) == values


@pytest.mark.parametrize("order", [1, -1])
def test_values_for_a_node_win_over_those_for_every_node(order: int) -> None:
    sections = ("/**: {ros__parameters: {gain: 1.0, name: x}}\n", "/arm: {ros__parameters: {gain: 2.0}}\n")
    text = "".join(sections[::order])
    found = dict(parameters_of_file(Source("x.yaml", text), "/arm", True))
    assert found == {"gain": ParameterValue(DOUBLE, 2.0), "name": ParameterValue(STRING, "x")}
    assert dict(parameters_of_file(Source("x.yaml", text), "/arm", False)).keys() == {"gain"}


@pytest.mark.parametrize(
    ("text", "identity", "place"),
    [
        ("/arm: {gain: 2.0}\n", "MG-9814", "1:1"),
        ("/leg: {ros__parameters: {gain: 2.0}}\n", "MG-9815", "1:1"),
        ("/arm: {ros__parameters: {gain: []}}\n", "MG-9816", "1:32"),
        ("/arm: {ros__parameters: {gain: [1, x]}}\n", "MG-9816", "1:32"),
    ],
)
def test_a_mistake_in_a_file_has_its_place(text: str, identity: str, place: str) -> None:
    with pytest.raises(UserError) as error:
        parameters_of_file(Source("x.yaml", text), "/arm", True)
    (diagnostic,) = error.value.diagnostics
    assert (diagnostic.id, str(diagnostic.span)) == (identity, f"x.yaml:{place}")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("2", ParameterValue(2, 2)),
        ("2.0", ParameterValue(3, 2.0)),
        ("true", ParameterValue(1, True)),
        ("fast", ParameterValue(4, "fast")),
        ("'2'", ParameterValue(4, "2")),
        ("", ParameterValue(4, "")),
        ("[1, 2]", ParameterValue(7, [1, 2])),
        ("[1, 2.5]", ParameterValue(8, [1.0, 2.5])),
        ("[true]", ParameterValue(6, [True])),
        ("[a, b]", ParameterValue(9, ["a", "b"])),
    ],
)
def test_a_text_is_a_value(text: str, expected: ParameterValue) -> None:
    assert value_from_text(text) == expected
