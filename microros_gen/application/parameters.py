# SPDX-License-Identifier: Apache-2.0
"""`parameters:` of a node → declarations of parameters, and whether their defaults are values that they accept."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from microros_gen.application.model import ParameterDecl
from microros_gen.application.parameter_hints import scalar_hint, size_hint, type_hint
from microros_gen.application.parameter_refusals import (
    RANGE_ENDS,
    Cause,
    Refusal,
    refusals,
    size_of_value,
)
from microros_gen.diagnostics import Diagnostic, Diagnostics, Span
from microros_gen.documents.tree_values import bool_of, child, items, number_of, size_of, span_of, text_of
from microros_gen.documents.yaml_tree import ScalarNode, SequenceNode, YamlNode
from microros_gen.records import dataclass

_VALUE_TYPES: Mapping[str, tuple[type, ...]] = {
    "bool": (bool,),
    "byte": (int,),
    "integer": (int,),
    "double": (int, float),
    "string": (str,),
}
_NUMBERS = ("integer", "double")
_LIMITS = {"byte": (0, 255), "integer": RANGE_ENDS["integer"]}
_Scalar = bool | int | float | str


def parse_declarations(tree: YamlNode | None, diagnostics: Diagnostics) -> tuple[ParameterDecl, ...]:
    """Return the declarations of a list, or of `declare` in a mapping.

    Each default that its parameter would refuse is an error at its place.
    """
    declared = child(tree, "declare") or tree
    return tuple(_parameter(item, diagnostics) for item in items(declared))


def _parameter(item: YamlNode, diagnostics: Diagnostics) -> ParameterDecl:
    bounds, default, choice = child(item, "range"), child(item, "default"), child(item, "one_of")
    parameter = ParameterDecl(
        name=text_of(child(item, "name")) or "",
        type=text_of(child(item, "type")) or "",
        default=value_of(default),
        description=text_of(child(item, "description")) or "",
        read_only=bool_of(child(item, "read_only")) or False,
        minimum=number_of(child(bounds, "min")),
        maximum=number_of(child(bounds, "max")),
        step=number_of(child(bounds, "step")),
        size=size_of(child(item, "size")),
        span=item.span,
        one_of=tuple(v for v in map(scalar_of, items(choice)) if v is not None),
        unit=text_of(child(item, "unit")) or "",
    )
    check_declaration(parameter, Places(default, span_of(bounds), choice), diagnostics)
    return parameter


def value_of(node: YamlNode | None) -> _Scalar | tuple[_Scalar, ...] | None:
    """Return a scalar, or the scalars of a list."""
    if isinstance(node, SequenceNode):
        return tuple(v for v in map(scalar_of, node.items) if v is not None)
    return scalar_of(node)


def scalar_of(node: YamlNode | None) -> _Scalar | None:
    """Return the value of a scalar."""
    return node.value if isinstance(node, ScalarNode) else None


@dataclass(frozen=True)
class Places:
    """Where the default, the range and the choice of a declaration are; None: it has none.

    `library`: in a file of generate_parameter_library, whose words hints have.
    """

    default: YamlNode | None
    bounds: Span | None
    choice: YamlNode | None
    library: bool = False


def check_declaration(parameter: ParameterDecl, places: Places, diagnostics: Diagnostics) -> None:
    """Report what contradicts itself in a declaration."""
    if parameter.type.removesuffix("[]") not in _VALUE_TYPES:
        return  # the schema says so
    before = len(tuple(diagnostics))
    _check_range(parameter, places, diagnostics)
    _check_choice(parameter, places, diagnostics)
    if parameter.is_array and not parameter.size:
        message = f"the array '{parameter.name}' has no size: how many elements it has at most"
        count = len(parameter.default) if isinstance(parameter.default, tuple) else 0
        diagnostics.error(message, parameter.span, f"Write size: {count or 8}", id="MG-3054")
    elif parameter.size == 0 and parameter.type == "string":
        hint = "Write type: string_fixed_8" if places.library else "Write size: 20, or remove `size`"
        message = f"the string '{parameter.name}' has a size of 0: it holds nothing"
        diagnostics.error(message, parameter.span, hint, id="MG-9851")
    elif parameter.size is not None and not (parameter.is_array or parameter.type == "string"):
        message = f"the parameter '{parameter.name}' is of type {parameter.type}, which has no size"
        diagnostics.error(message, parameter.span, "Remove `size`", id="MG-3055")
    if places.default is not None and parameter.default is not None:
        what = f"the default of the parameter '{parameter.name}'"
        sound = parameter if len(tuple(diagnostics)) == before else _without_constraints(parameter)
        check_value(sound, parameter.default, places.default.span, what, diagnostics, library=places.library)
    elif len(tuple(diagnostics)) == before:
        diagnostics.extend(_missing_default(parameter))


def _without_constraints(parameter: ParameterDecl) -> ParameterDecl:
    """Return a parameter whose constraints are wrong themselves without them: no value is right for them."""
    return replace(parameter, minimum=None, maximum=None, step=None, one_of=())


def _missing_default(parameter: ParameterDecl) -> Iterator[Diagnostic]:
    """Yield that a parameter starts with a value that it does not accept: without a default it is 0, or empty."""
    what = f"the parameter '{parameter.name}' has no default and starts with"
    low, high = parameter.minimum, parameter.maximum
    if parameter.type in _NUMBERS and low is not None and high is not None and not low <= 0 <= high:
        message = f"{what} 0, which is not in its range"
        yield Diagnostic(message, parameter.span, f"Write `default: {low}`", id="MG-3096")
    if not parameter.one_of:
        return
    start: _Scalar = "" if parameter.type == "string" else 0
    if start not in parameter.one_of:
        message = f"{what} {start!r}, which is none of its values"
        yield Diagnostic(message, parameter.span, f"Write `default: {parameter.one_of[0]}`", id="MG-3097")


def _fits(value: _Scalar, kind: str) -> bool:
    wanted = _VALUE_TYPES.get(kind)
    if wanted is None:
        return True
    if not isinstance(value, wanted) or (isinstance(value, bool) and kind != "bool"):
        return False
    limits = _LIMITS.get(kind)
    return limits is None or limits[0] <= value <= limits[1]  # type: ignore[operator]


def check_value(
    parameter: ParameterDecl,
    value: _Scalar | tuple[_Scalar, ...],
    span: Span,
    what: str,
    diagnostics: Diagnostics,
    library: bool = False,
) -> None:
    """Report why the parameter does not accept a value; `what` names it at the beginning of a sentence.

    `library`: the parameter is declared in a file of generate_parameter_library.
    """
    kind = parameter.type.removesuffix("[]")
    elements = value if isinstance(value, tuple) else (value,)
    fits = all(element is not None and _fits(element, kind) for element in elements)
    if isinstance(value, tuple) != parameter.is_array or not fits:
        message = f"{what} is not of type {parameter.type}"
        diagnostics.error(message, span, type_hint(parameter, value, library), id="MG-3005")
        return
    if not all(map(_is_finite, elements)):
        message = f"{what} is not a finite number"
        diagnostics.error(message, span, "Set it in the program", id="MG-3063")
        return
    for refusal in refusals(parameter, value):
        if library and refusal.cause is Cause.SIZE:
            refusal = Refusal(refusal.cause, size_hint(parameter, size_of_value(value)))
        diagnostics.extend([_refused(refusal, what, span)])


def _refused(refusal: Refusal, what: str, span: Span) -> Diagnostic:
    if refusal.cause is Cause.RANGE:
        return Diagnostic(f"{what} is not in its range", span, refusal.hint, id="MG-3006")
    if refusal.cause is Cause.STEP:
        return Diagnostic(f"{what} is between two steps of its range", span, refusal.hint, id="MG-3062")
    if refusal.cause is Cause.SIZE:
        return Diagnostic(f"{what} is longer than its size", span, refusal.hint, id="MG-3007")
    return Diagnostic(f"{what} is none of its values", span, refusal.hint, id="MG-3056")


def _check_range(parameter: ParameterDecl, places: Places, diagnostics: Diagnostics) -> None:
    span = places.bounds
    if span is None:
        return
    low, high, step = parameter.minimum, parameter.maximum, parameter.step
    if parameter.type not in _NUMBERS:
        article = "an" if parameter.type.startswith("integer") else "a"
        message = f"the parameter '{parameter.name}' is {article} {parameter.type}, which has no range"
        diagnostics.error(message, span, "Remove `range`", id="MG-3008")
    elif low is not None and high is not None and low > high:
        message = f"the range of the parameter '{parameter.name}' is empty: min is above max"
        diagnostics.error(message, span, _swapped(parameter, places.library), id="MG-3009")
    elif not all(map(_is_finite, (low, high, step))):
        message = f"the range of the parameter '{parameter.name}' has a number that is not finite"
        diagnostics.error(message, span, "Write finite numbers", id="MG-3099")
    elif parameter.type == "integer" and not all(_is_int64(v) for v in (low, high, step)):
        message = f"the range of the parameter '{parameter.name}' has a number that is no integer of 64 bits"
        diagnostics.error(message, span, "Write whole numbers, or type: double", id="MG-3057")


def _swapped(parameter: ParameterDecl, library: bool) -> str:
    """Return the range that was meant where its smallest number is above its largest."""
    low, high = parameter.minimum, parameter.maximum
    if library:
        return f"Write bounds<>: [{high}, {low}], or remove one of the rules"
    step = "" if parameter.step is None else f", step: {parameter.step}"
    return f"Write {{min: {high}, max: {low}{step}}}"


def _is_finite(value: _Scalar | None) -> bool:
    return not isinstance(value, float) or math.isfinite(value)


def _is_int64(value: int | float | None) -> bool:
    return value is None or (isinstance(value, int) and _fits(value, "integer"))


def _check_choice(parameter: ParameterDecl, places: Places, diagnostics: Diagnostics) -> None:
    if places.choice is None:
        return
    if parameter.type not in (*_NUMBERS, "string"):
        message = f"the parameter '{parameter.name}' is of type {parameter.type}, which has no `one_of`"
        diagnostics.error(message, places.choice.span, "Remove `one_of`", id="MG-3058")
    elif places.bounds is not None:
        message = f"the parameter '{parameter.name}' has both `range` and `one_of`"
        hint = "Remove `one_of<>`" if places.library else "Remove `one_of`"
        diagnostics.error(message, places.choice.span, hint, id="MG-3059")
    else:
        _check_choices(parameter, places.choice, diagnostics)


def _check_choices(parameter: ParameterDecl, choice: YamlNode, diagnostics: Diagnostics) -> None:
    for node in items(choice):
        value = scalar_of(node)
        if value is None or not _fits(value, parameter.type):
            message = f"a value of `one_of` is not of type {parameter.type}"
            diagnostics.error(message, node.span, scalar_hint(parameter.type, value), id="MG-3060")
        elif not _is_finite(value):
            message = f"a value of the parameter '{parameter.name}' is not a finite number"
            diagnostics.error(
                message, node.span, "Remove it, or check the value in the callback", id="MG-3100"
            )
        elif isinstance(value, str) and parameter.size is not None and len(value.encode()) > parameter.size:
            message = f"'{value}' is longer than the size of the parameter '{parameter.name}'"
            diagnostics.error(message, node.span, f"Set size: {len(value.encode())}", id="MG-3061")
