# SPDX-License-Identifier: Apache-2.0
"""`validation` of a parameter in a file of generate_parameter_library → range, list of values, size and rules."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import replace

from microros_gen.application.model import ParameterDecl, ParameterRule, Scalar
from microros_gen.application.parameter_hints import rule_hint
from microros_gen.application.parameter_refusals import RANGE_ENDS
from microros_gen.application.parameter_rules import refusal
from microros_gen.application.parameters import scalar_of
from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.tree_values import items
from microros_gen.documents.yaml_tree import Entry, SequenceNode, YamlNode

_NUMBERS = ("integer", "double")
_TYPES: Mapping[str, tuple[type, ...]] = {
    "bool": (bool,),
    "integer": (int,),
    "double": (int, float),
    "string": (str,),
}


def with_rule(parameter: ParameterDecl, rule: Entry, diagnostics: Diagnostics) -> ParameterDecl:
    """Return the parameter with a rule of its validation."""
    name = rule.key.removesuffix("<>")
    apply = _RULES.get(name)
    if apply is None or not rule.key.endswith("<>"):
        known = [f"{known}<>" for known in _RULES]
        message = f"a device does not check '{rule.key}'"
        hint = (
            f"Check it in the callback of rclc_executor_add_parameter_server; available: {', '.join(known)}"
        )
        if rule.key in _RULES:
            hint = f"Write {rule.key}<>"
        elif "::" not in rule.key:
            hint = nearest(rule.key, known) or hint
        diagnostics.error(message, rule.key_span, hint, id="MG-3071")
        return parameter
    ruled = apply(parameter, name, rule.value)
    if ruled is None:
        message = f"'{rule.key}' does not fit '{parameter.name}' of type {parameter.type}"
        hint = f"Write {rule.key}: {_USES[name]}"
        if name == "one_of" and (values := _arguments(rule.value)):
            hint = f"Write {rule.key}: [{json.dumps(values, ensure_ascii=False)}]"
        diagnostics.error(message, rule.value.span, hint, id="MG-3072")
    return ruled or parameter


def check_rules(
    parameter: ParameterDecl,
    value: Scalar | tuple[Scalar, ...],
    span: Span,
    what: str,
    diagnostics: Diagnostics,
) -> None:
    """Report the first rule that a value does not follow, with the reason that a set request would get.

    `what` names the value at the beginning of a sentence.
    """
    if parameter.type.removesuffix("[]") == "double":
        value = tuple(map(_float, value)) if isinstance(value, tuple) else _float(value)
    reasons = (refusal(rule, parameter.name, value) for rule in parameter.rules)
    reason = next(filter(None, reasons), None)
    if reason is not None:
        message = f"{what} does not follow its validation"
        diagnostics.error(message, span, rule_hint(parameter, value, reason), id="MG-3077")


def _float(value: Scalar) -> Scalar:
    return float(value) if isinstance(value, int) else value


def _arguments(node: YamlNode) -> tuple[Scalar, ...] | None:
    """Return what a rule is given: a list, one value without its brackets, or nothing; None: something else."""
    nodes = items(node) if isinstance(node, SequenceNode) else () if scalar_of(node) is None else (node,)
    values = [v for v in map(scalar_of, nodes) if v is not None]
    return tuple(values) if len(values) == len(nodes) else None


def _typed(parameter: ParameterDecl, node: YamlNode, count: int) -> tuple[Scalar, ...] | None:
    """Return `count` arguments of the type of the parameter, or of its elements; None where they are others."""
    kind = parameter.type.removesuffix("[]")
    values = _arguments(node)
    if values is None or len(values) != count:
        return None
    fitting = [v for v in values if isinstance(v, _TYPES[kind]) and isinstance(v, bool) == (kind == "bool")]
    if len(fitting) != count or not all(math.isfinite(v) for v in fitting if isinstance(v, float)):
        return None
    return tuple(map(_float, fitting)) if kind == "double" else tuple(fitting)


def _numbers(parameter: ParameterDecl, node: YamlNode, count: int) -> list[int | float] | None:
    """Return the arguments of a rule for numbers; None where they are others."""
    found = _arguments(node) or ()
    numbers = [n for n in found if isinstance(n, (int, float)) and not isinstance(n, bool)]
    return numbers if parameter.type in _NUMBERS and len(numbers) == len(found) == count else None


def _within(
    parameter: ParameterDecl, low: int | float | None = None, high: int | float | None = None
) -> ParameterDecl:
    """Return the parameter with a range that these ends make narrower."""
    first, last = RANGE_ENDS[parameter.type]
    lows = [n for n in (parameter.minimum, low) if n is not None]
    highs = [n for n in (parameter.maximum, high) if n is not None]
    return replace(parameter, minimum=max(lows, default=first), maximum=min(highs, default=last))


def _bounds(parameter: ParameterDecl, _name: str, node: YamlNode) -> ParameterDecl | None:
    numbers = _numbers(parameter, node, 2)
    return None if numbers is None else _within(parameter, *numbers)


def _low(parameter: ParameterDecl, _name: str, node: YamlNode) -> ParameterDecl | None:
    numbers = _numbers(parameter, node, 1)
    return None if numbers is None else _within(parameter, low=numbers[0])


def _high(parameter: ParameterDecl, _name: str, node: YamlNode) -> ParameterDecl | None:
    numbers = _numbers(parameter, node, 1)
    return None if numbers is None else _within(parameter, high=numbers[0])


def _above(parameter: ParameterDecl, name: str, node: YamlNode) -> ParameterDecl | None:
    """Return it with a range that begins at the next number; ROS also accepts what is almost its end."""
    numbers = _numbers(parameter, node, 1)
    if numbers is None:
        return None
    if parameter.type == "integer":
        return _within(parameter, low=int(numbers[0]) + 1)
    end = float(numbers[0])
    return _with(_within(parameter, low=math.nextafter(end, math.inf)), name, (end,))


def _below(parameter: ParameterDecl, name: str, node: YamlNode) -> ParameterDecl | None:
    numbers = _numbers(parameter, node, 1)
    if numbers is None:
        return None
    if parameter.type == "integer":
        return _within(parameter, high=int(numbers[0]) - 1)
    end = float(numbers[0])
    return _with(_within(parameter, high=math.nextafter(end, -math.inf)), name, (end,))


def _with(parameter: ParameterDecl, name: str, values: tuple[Scalar, ...]) -> ParameterDecl:
    return replace(parameter, rules=(*parameter.rules, ParameterRule(name, values)))


def _one_of(parameter: ParameterDecl, name: str, node: YamlNode) -> ParameterDecl | None:
    """Return it with the list, which other nodes are shown, and a rule: it has the reason of the library."""
    lists = items(node)
    values = [v for v in map(scalar_of, items(lists[0]) if len(lists) == 1 else ()) if v is not None]
    if not values:
        return None
    listed = tuple(values) if parameter.type != "double" else tuple(map(_float, values))
    return _with(replace(parameter, one_of=tuple(values)), name, listed)


def _subset_of(parameter: ParameterDecl, name: str, node: YamlNode) -> ParameterDecl | None:
    lists = items(node)
    values = _typed(parameter, lists[0], len(items(lists[0]))) if len(lists) == 1 else None
    return _with(parameter, name, values) if values and parameter.is_array else None


def _has_size(parameter: ParameterDecl) -> bool:
    return parameter.is_array or parameter.type == "string"


def _size(parameter: ParameterDecl, name: str, node: YamlNode) -> ParameterDecl | None:
    """Return it with a rule for its size, which also says how long it is at most where it does."""
    arguments = _arguments(node) or ()
    count = arguments[0] if len(arguments) == 1 else None
    least = _LEAST[name]
    if isinstance(count, bool) or not isinstance(count, int) or not least <= count < 2**31:
        return None
    if not _has_size(parameter):
        return None
    sizes = {"size_lt": (count - 1,), "fixed_size": (count,)}.get(name, ())
    most = min((n for n in (parameter.size, *sizes) if n is not None), default=None)
    return _with(replace(parameter, size=most), name, (count,))


_LEAST = {"fixed_size": 1, "size_gt": 0, "size_lt": 2}
"""The smallest argument: nothing is shorter than 0, and what is always empty has no place."""


def _not_empty(parameter: ParameterDecl, name: str, node: YamlNode) -> ParameterDecl | None:
    return _with(parameter, name, ()) if _arguments(node) == () and _has_size(parameter) else None


def _unique(parameter: ParameterDecl, name: str, node: YamlNode) -> ParameterDecl | None:
    return _with(parameter, name, ()) if _arguments(node) == () and parameter.is_array else None


def _elements(parameter: ParameterDecl, name: str, node: YamlNode) -> ParameterDecl | None:
    values = _typed(parameter, node, 2 if name == "element_bounds" else 1)
    if values is None or parameter.type not in ("integer[]", "double[]"):
        return None
    return _with(parameter, name, values)


_RULES: Mapping[str, Callable[[ParameterDecl, str, YamlNode], ParameterDecl | None]] = {
    "bounds": _bounds,
    "gt": _above,
    "lt": _below,
    "gt_eq": _low,
    "lt_eq": _high,
    "lower_bounds": _low,
    "upper_bounds": _high,
    "one_of": _one_of,
    "size_lt": _size,
    "size_gt": _size,
    "fixed_size": _size,
    "not_empty": _not_empty,
    "unique": _unique,
    "subset_of": _subset_of,
    "element_bounds": _elements,
    "lower_element_bounds": _elements,
    "upper_element_bounds": _elements,
}
"""What a device checks: the rule without its `<>`; None: the arguments do not fit the parameter."""
_USES: Mapping[str, str] = {
    "bounds": "[0, 10], for an int or double",
    **dict.fromkeys(("gt", "lt", "gt_eq", "lt_eq"), "[0], for an int or double"),
    **dict.fromkeys(("lower_bounds", "upper_bounds"), "[0], for an int or double"),
    "one_of": "[[1, 2]], for an int, double or string",
    **dict.fromkeys(("size_lt", "size_gt", "fixed_size"), "[9], for a string or array"),
    "not_empty": "[], for a string or array",
    "unique": "[], for an array",
    "subset_of": "[[1, 2]], with values of the array's type",
    "element_bounds": "[0, 10], for an array of ints or doubles",
    **dict.fromkeys(("lower_element_bounds", "upper_element_bounds"), "[0], for an array of ints or doubles"),
}
