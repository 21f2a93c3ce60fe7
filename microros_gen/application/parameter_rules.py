# SPDX-License-Identifier: Apache-2.0
"""Rules that generate_parameter_library adds to those of ROS: which values they refuse, and with which reason.

The reasons are those of https://github.com/PickNikRobotics/RSL, which the library calls in C++. A device makes them of
the same words.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from microros_gen.application.model import ParameterRule, Scalar

_LIMITS = {
    "element_bounds": "within bounds '[{}, {}]'",
    "lower_element_bounds": "above lower bound of '{}'",
    "upper_element_bounds": "below upper bound of '{}'",
}
_SIZES = {"fixed_size": "equal to", "size_gt": "greater than", "size_lt": "less than"}
_NUMBERS = {"gt": "greater than", "lt": "less than"}


def words_of(rule: ParameterRule) -> tuple[str, str]:
    """Return the reason in two parts.

    The first one has `%n` for the name, `%s` for the size and `%v` for the value or element.
    """
    shown = [shown_value(value) for value in rule.values]
    if rule.name in _SIZES:
        return "Length of parameter '%n' is '%s' but must be ", f"{_SIZES[rule.name]} '{shown[0]}'"
    if rule.name in _LIMITS:
        return "Value '%v' in parameter '%n' must be ", _LIMITS[rule.name].format(*shown)
    if rule.name in _NUMBERS:
        return "Parameter '%n' with the value '%v' must be ", f"{_NUMBERS[rule.name]} '{shown[0]}'"
    if rule.name == "one_of":
        return "Parameter '%n' with the value '%v' is not in the set ", f"'{{{', '.join(shown)}}}'"
    if rule.name == "subset_of":
        return "Entry '%v' in parameter '%n' is not in the set ", f"'{{{', '.join(shown)}}}'"
    return "Parameter '%n' ", _WITHOUT_VALUES[rule.name]


_WITHOUT_VALUES = {"not_empty": "cannot be empty", "unique": "must only contain unique values"}


def shown_value(value: Scalar) -> str:
    """Return a value as a reason shows it: a floating-point number with six digits."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:g}" if isinstance(value, float) else str(value)


def refusal(rule: ParameterRule, name: str, value: Scalar | tuple[Scalar, ...]) -> str:
    """Return why a parameter of that name cannot have a value of its type; empty: it can."""
    size = len(value.encode()) if isinstance(value, str) else len(value) if isinstance(value, tuple) else 0
    holds = _SIZE_TESTS.get(rule.name)
    faults: Iterator[Scalar]
    if holds is not None:
        faults = iter(() if holds(size, rule.values) else (size,))
    elif rule.name == "unique" and isinstance(value, tuple):
        faults = (element for index, element in enumerate(value) if element in value[:index])
    else:
        test = _ELEMENT_TESTS[rule.name]
        elements = value if isinstance(value, tuple) else (value,)
        faults = (element for element in elements if not test(element, rule.values))
    found = next(faults, None)
    if found is None:
        return ""
    words, rest = words_of(rule)
    return words.replace("%n", name).replace("%s", str(size)).replace("%v", shown_value(found)) + rest


def _number(value: Scalar) -> int | float:
    return 0 if isinstance(value, str) else value


_Test = Callable[[Scalar, tuple[Scalar, ...]], bool]
_SIZE_TESTS: Mapping[str, Callable[[int, tuple[Scalar, ...]], bool]] = {
    "fixed_size": lambda size, values: size == values[0],
    "not_empty": lambda size, values: size > 0,
    "size_gt": lambda size, values: size > _number(values[0]),
    "size_lt": lambda size, values: size < _number(values[0]),
}
_ELEMENT_TESTS: Mapping[str, _Test] = {
    "element_bounds": lambda value, values: (
        not (_number(value) < _number(values[0]) or _number(value) > _number(values[1]))
    ),
    "gt": lambda value, values: _number(value) > _number(values[0]),
    "lower_element_bounds": lambda value, values: not _number(value) < _number(values[0]),
    "lt": lambda value, values: _number(value) < _number(values[0]),
    "one_of": lambda value, values: value in values,
    "subset_of": lambda value, values: value in values,
    "upper_element_bounds": lambda value, values: not _number(value) > _number(values[0]),
}
