# SPDX-License-Identifier: Apache-2.0
"""Annotations of .idl files (OMG IDL 4.2, 7.4.15.4.2): documentation, units and defaults.

Ranges are in the C code next to them. All others are read but have no effect: ROS 2 Jazzy keeps none of them in C.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from microros_gen.diagnostics import Source, Span
from microros_gen.interfaces.msg.syntax import SyntaxNode
from microros_gen.interfaces.omg_idl.values import IdlError, literal_value, span_of, tokens_of
from microros_gen.interfaces.types import ScalarValue
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Default:
    """The value of `@default` and its place."""

    value: ScalarValue
    span: Span


@dataclass(frozen=True)
class Annotations:
    """What the annotations of one declaration say."""

    comment: tuple[str, ...] = ()
    default: Default | None = None


def read_annotations(
    node: SyntaxNode, constants: Mapping[str, SyntaxNode], source: Source, *, known_only: bool = False
) -> Annotations:
    """Return what the annotations below `node` say. Raises IdlError for what stops ROS 2 Jazzy.

    `known_only` says that Jazzy does not read the parameters of annotations here, whatever they are.
    """
    if not node.children:
        return Annotations()
    comment: list[str] = []
    units: list[str] = []
    defaults: list[Default] = []
    limits: dict[str, ScalarValue] = {}
    for annotation in node.children:
        name = next(str(token) for token in tokens_of(annotation.children[0]) if token.type == "IDENTIFIER")
        span = span_of(annotation, source)
        if known_only and name not in ("verbatim", "unit", "default"):
            continue
        values = dict(_parameters(annotation.children[1:], constants, source))
        if name == "verbatim":
            comment.extend(_verbatim(values, span))
        elif name == "unit":
            units.extend(value for value in values.values() if isinstance(value, str))
        elif name in ("range", "min", "max"):
            limits.update(_limits(name, values))
        elif name == "default":
            defaults.append(Default(_default_value(values, span), _value_span(annotation, source)))
    if len(defaults) > 1:
        raise IdlError(
            defaults[1].span,
            "two defaults: ROS 2 Jazzy uses neither of them",
            "Remove one",
            id="MG-2033",
        )
    lines = (*_with_unit(comment, units), *_range(limits))
    return Annotations(lines, defaults[0] if defaults else None)


def _parameters(
    nodes: Sequence[SyntaxNode], constants: Mapping[str, SyntaxNode], source: Source
) -> Iterator[tuple[str, ScalarValue | None]]:
    """Yield name and value of each parameter; the only one may have no name, a name for a value has None."""
    for node in nodes:
        name, value = ("", node) if node.data != "parameter" else (str(node.children[0]), node.children[1])
        if value.data == "name":
            yield name, None
        else:
            yield name, literal_value(value, constants, source, parameter=True)


def _verbatim(values: Mapping[str, ScalarValue | None], span: Span) -> list[str]:
    if not values:
        raise IdlError(
            span, "@verbatim without a text", 'Write @verbatim (language="comment", text="…")', id="MG-2060"
        )
    text = values.get("text")
    if values.get("language") != "comment" or "text" not in values:
        return []
    if not isinstance(text, str):
        raise IdlError(span, "the text of @verbatim is a string", "Write it in quotes", id="MG-2061")
    return text.splitlines()


def _limits(name: str, values: Mapping[str, ScalarValue | None]) -> Iterator[tuple[str, ScalarValue]]:
    """Yield the ends of a range: `@range (min=…, max=…)`, `@min (…)`, `@max (…)` (OMG IDL 4.2, 8.3.2)."""
    for key, value in values.items():
        end = name if name != "range" else key
        if value is not None and end in ("min", "max"):
            yield end, value


def _range(limits: Mapping[str, ScalarValue]) -> Iterator[str]:
    low, high = limits.get("min"), limits.get("max")
    if low is not None and high is not None:
        yield f"Range: {low} to {high}"
    elif low is not None or high is not None:
        yield f"At most {high}" if low is None else f"At least {low}"


def _value_span(annotation: SyntaxNode, source: Source) -> Span:
    values = (node.children[1] for node in annotation.children[1:] if node.children[0] == "value")
    return span_of(next(values), source)


def _default_value(values: Mapping[str, ScalarValue | None], span: Span) -> ScalarValue:
    if "value" not in values:
        raise IdlError(span, "@default has no parameter 'value'", "Write @default (value=…)", id="MG-2062")
    value = values["value"]
    if value is None:
        raise IdlError(
            span, "ROS 2 Jazzy does not accept a name as a default", "Write the value itself", id="MG-2063"
        )
    return value


def _with_unit(comment: Sequence[str], units: Sequence[str]) -> tuple[str, ...]:
    """Return the lines with the unit in brackets after the last one, unless a line has it already.

    In a .msg file a unit stands somewhere in the comment; rosidl_adapter takes it out of its line.
    """
    lines = list(comment)
    for unit in units:
        if any(f"[{unit}]" in line for line in lines):
            continue
        if lines:
            lines[-1] = f"{lines[-1]} [{unit}]".lstrip()
        else:
            lines.append(f"[{unit}]")
    return tuple(lines)
