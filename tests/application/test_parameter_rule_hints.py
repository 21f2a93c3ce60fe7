# SPDX-License-Identifier: Apache-2.0
"""The value that a hint gives instead of one that does not follow a validation can be pasted, and follows it."""

from __future__ import annotations

import json

import pytest

from microros_gen.application.model import ParameterDecl, ParameterRule, Scalar
from microros_gen.application.parameter_hints import rule_hint
from microros_gen.application.parameter_rules import refusal

Value = Scalar | tuple[Scalar, ...]


def hint(kind: str, value: Value, *rules: tuple[str, tuple[Scalar, ...]]) -> str:
    """Return the hint without its reason, which is that of a rule."""
    created = tuple(ParameterRule(name, values) for name, values in rules)
    parameter = ParameterDecl(name="p", type=kind, rules=created)
    reason = next(filter(None, (refusal(rule, "p", value) for rule in created)))
    text = rule_hint(parameter, value, reason)
    assert text.endswith(f": {reason}")
    return text.removesuffix(f": {reason}")


@pytest.mark.parametrize(
    ("kind", "value", "rule", "arguments", "wanted"),
    [
        ("integer", 3, "gt", (3,), 4),
        ("integer", 9, "lt", (3,), 2),
        ("double", 0.0, "gt", (0.5,), 1.5),
        ("string", "abc", "size_lt", (3,), "ab"),
        ("string", "a", "size_gt", (2,), "aaa"),
        ("string", "", "not_empty", (), "x"),
        ("string", "c", "one_of", ("a", "b"), "a"),
        ("integer[]", (1, 2, 3), "fixed_size", (2,), [1, 2]),
        ("integer[]", (1,), "size_gt", (2,), [1, 1, 1]),
        ("integer[]", (1, 2, 1), "unique", (), [1, 2]),
        ("integer[]", (1, 20), "element_bounds", (0, 9), [1, 9]),
        ("double[]", (1.0, -2.0), "lower_element_bounds", (0.0,), [1.0, 0.0]),
        ("double[]", (1.0, 2.0), "upper_element_bounds", (1.5,), [1.0, 1.5]),
        ("string[]", ("a", "x"), "subset_of", ("a", "b"), ["a", "a"]),
    ],
)
def test_the_closest_value(
    kind: str, value: Value, rule: str, arguments: tuple[Scalar, ...], wanted: object
) -> None:
    text = hint(kind, value, (rule, arguments))
    assert text.startswith("Write ")
    assert json.loads(text.removeprefix("Write ")) == wanted


def test_rules_that_are_in_conflict_get_no_value() -> None:
    """Three different ones of two accepted words do not exist, nor does an element of an empty list."""
    assert hint("string[]", ("a", "a", "b"), ("unique", ()), ("fixed_size", (3,))) == "Write another value"
    assert hint("integer[]", (), ("not_empty", ())) == "Write another value"
