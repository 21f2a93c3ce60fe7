# SPDX-License-Identifier: Apache-2.0
"""Messages from YAML: what follows the type in `topic pub`, `service call` and `action send-goal`.

Every mistake has its place in the text. A number is accepted as a text, and a text that is a number as a number, as on
the ros2 command line. A bool needs true, false, 0 or 1: there, every text but the empty one is true.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from microros_gen.diagnostics import Diagnostics, Source, nearest
from microros_gen.documents.yaml_tree import MappingNode, ScalarNode, SequenceNode, YamlNode, parse_yaml
from microros_gen.interfaces.types import (
    ArrayType,
    ElementType,
    Field,
    FieldType,
    Message,
    NamedType,
    Primitive,
    StringType,
    TypeName,
)
from microros_gen.ros.steps import OCTETS
from microros_gen.ros_tools.texts import Messages

_TIME = TypeName("builtin_interfaces", "msg", "Time")
_HEADER = TypeName("std_msgs", "msg", "Header")
_FLOATS = (Primitive.FLOAT32, Primitive.FLOAT64, Primitive.LONG_DOUBLE)
Stamp = Mapping[str, int]
"""A builtin_interfaces/msg/Time: `sec`, `nanosec`."""


class Filled:
    """A message as the user wrote it; `value` lacks the members that have their defaults."""

    def __init__(self) -> None:
        self.value: dict[str, Any] = {}
        self._stamped: list[Callable[[Stamp], None]] = []

    def stamp(self, time: Stamp) -> None:
        """Set each time that is `now`, and the stamp of each header that is `auto`."""
        for set_time in self._stamped:
            set_time(time)

    def stamp_later(self, holder: dict[str, Any], member: str) -> None:
        """Let `stamp` set a member of a part of the message."""
        self._stamped.append(lambda time: holder.__setitem__(member, dict(time)))


def fill(text: str, name: TypeName, messages: Messages, what: str = "values") -> Filled:
    """Return the message that a YAML text describes; an empty text means all defaults.

    `what` names the text in diagnostics. Raises UserError with every mistake: YAML that cannot be read, unknown
    members, values of another type.
    """
    diagnostics = Diagnostics()
    source = Source(f"<{what}>", text)
    node = parse_yaml(source, diagnostics) if text.strip() else None
    filled = Filled()
    if node is not None:
        _Filler(messages, diagnostics, filled).message(node, messages[name], filled.value)
    diagnostics.check()
    return filled


class _Filler:
    def __init__(self, messages: Messages, diagnostics: Diagnostics, filled: Filled) -> None:
        self._messages = messages
        self._diagnostics = diagnostics
        self._filled = filled

    def message(self, node: YamlNode, message: Message, into: dict[str, Any]) -> None:
        """Add the members that a mapping names to `into`."""
        if not isinstance(node, MappingNode):
            names = ", ".join(f"{field.name}: …" for field in message.fields[:3])
            self._diagnostics.error(
                f"{message.name} takes a mapping of its members",
                node.span,
                f"Write '{{{names}}}'",
                id="MG-9801",
            )
            return
        fields = {field.name: field for field in message.fields}
        for entry in node:
            field = fields.get(entry.key)
            if field is None:
                known = ", ".join(fields) or "none"
                hint = nearest(entry.key, fields) or f"Its members: {known}"
                self._diagnostics.error(
                    f"unknown member '{entry.key}' of {message.name}", entry.key_span, hint, id="MG-9802"
                )
            elif not self._is_stamp(entry.value, field, into):
                self._add(entry.value, field, into)

    def _is_stamp(self, node: YamlNode, field: Field, into: dict[str, Any]) -> bool:
        if not isinstance(node, ScalarNode) or not isinstance(field.type, NamedType):
            return False
        if field.type.name == _TIME and node.value == "now":
            self._filled.stamp_later(into, field.name)
            return True
        if field.type.name == _HEADER and node.value == "auto":
            into[field.name] = {}
            self._filled.stamp_later(into[field.name], "stamp")
            return True
        return False

    def _add(self, node: YamlNode, field: Field, into: dict[str, Any]) -> None:
        if isinstance(field.type, NamedType):
            into[field.name] = {}
            self.message(node, self._messages[field.type.name], into[field.name])
            return
        value = self._value(node, field.type, field.name)
        if value is not None:
            into[field.name] = value

    def _value(self, node: YamlNode, kind: FieldType, label: str) -> Any:
        if isinstance(kind, (Primitive, StringType, NamedType)):
            return self._element(node, kind, label)
        if not isinstance(node, SequenceNode):
            self._diagnostics.error(
                f"{label} takes a list", node.span, f"Write '{label}: [ … ]'", id="MG-9803"
            )
            return None
        most = kind.size if isinstance(kind, ArrayType) else kind.bound
        count = len(node.items)
        if most is not None and (count > most or (isinstance(kind, ArrayType) and count != most)):
            expected = "exactly" if isinstance(kind, ArrayType) else "at most"
            self._diagnostics.error(
                f"{label} takes {expected} {most} elements, not {count}", node.span, id="MG-9804"
            )
            return None
        values = [self._element(item, kind.element, f"{label}[{i}]") for i, item in enumerate(node.items)]
        whole = kind.element in OCTETS and None not in values
        return bytes(values) if whole else values

    def _element(self, node: YamlNode, kind: ElementType, label: str) -> Any:
        if isinstance(kind, NamedType):
            value: dict[str, Any] = {}
            self.message(node, self._messages[kind.name], value)
            return value
        fits = _scalar(node, kind) if isinstance(node, ScalarNode) and node.value is not None else None
        if fits is None:
            self._diagnostics.error(f"{label} takes {_expected(kind)}", node.span, id="MG-9805")
        return fits


def _scalar(node: ScalarNode, kind: Primitive | StringType) -> Any:
    """Return a scalar of YAML as a value of a type; None if it has no such value."""
    found = node.value
    if isinstance(kind, StringType):
        return node.text if kind.bound is None or len(node.text) <= kind.bound else None
    if kind is Primitive.BOOL:
        return bool(found) if isinstance(found, bool) or found in (0, 1) else None
    if isinstance(found, bool):
        return None
    if kind in _FLOATS:
        return _number(found, float)
    if (
        kind in (Primitive.BYTE, Primitive.IDL_CHAR, Primitive.WCHAR)
        and isinstance(found, str)
        and len(found) == 1
    ):
        found = ord(found)
    value = _number(found, int)
    return value if value is not None and _in_range(value, kind) else None


def _number(found: Any, kind: type[int] | type[float]) -> int | float | None:
    if kind is int and isinstance(found, float):
        return int(found) if math.isfinite(found) and found.is_integer() else None
    try:
        return kind(found)
    except (TypeError, ValueError, OverflowError):
        return None


def _in_range(value: int | float, kind: Primitive) -> bool:
    low, high = _range(kind)
    return low <= value <= high


def _range(kind: Primitive) -> tuple[int, int]:
    bits = 8 * kind.size
    signed = kind.value.startswith("int")
    return (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if signed else (0, 2**bits - 1)


def _expected(kind: Primitive | StringType) -> str:
    if isinstance(kind, StringType):
        return "a text" if kind.bound is None else f"a text of at most {kind.bound} characters"
    if kind is Primitive.BOOL:
        return "true or false"
    if kind in _FLOATS:
        return f"a number ({kind.value})"
    low, high = _range(kind)
    return f"an integer from {low} to {high} ({kind.value})"
