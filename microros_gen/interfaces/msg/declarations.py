# SPDX-License-Identifier: Apache-2.0
"""From the syntax tree of one declaration in a .msg file to a field or a constant, with every check of its
parts."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.interfaces.msg import names as msg_names
from microros_gen.interfaces.msg.fault import Fault
from microros_gen.interfaces.msg.hints import is_unsigned_of_c, type_hint
from microros_gen.interfaces.msg.syntax import Node, Word
from microros_gen.interfaces.msg.values import (
    InvalidValueError,
    positive_integer,
    primitive_value,
    scalar_value,
    string_elements,
)
from microros_gen.interfaces.types import (
    ArrayType,
    Constant,
    ElementType,
    Field,
    FieldType,
    NamedType,
    Primitive,
    ScalarValue,
    SequenceType,
    StringType,
    TypeName,
    Value,
)
from microros_gen.records import dataclass

LARGEST_BOUND = 2**32 - 1
"""The most elements or characters that CDR can count: lengths have 32 bits (DDS-XTypes 1.3, 7.4.3)."""

_PRIMITIVES = {p.value: p for p in Primitive if p.in_msg}
_ONCE_PRIMITIVE = {"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration"}


@dataclass(frozen=True)
class Line:
    """One declaration as text; `commented` says whether a comment follows it."""

    source: Source
    number: int
    text: str
    commented: bool

    def span(self, column: int, end: int) -> Span:
        """Return the place from `column` up to `end` (exclusive) in this line."""
        return Span(self.source, self.number, column, max(end, column + 1))

    def span_of(self, token: Word) -> Span:
        """Return the place of `token` without the space around it."""
        column = _column(token) + len(token) - len(token.lstrip())
        return self.span(column, column + len(token.strip()))


@dataclass(frozen=True)
class Declaration:
    """A field or constant (without its comment) and where its name stands."""

    element: Field | Constant
    name_span: Span

    @property
    def name(self) -> str:
        """The declared name."""
        return self.element.name


class _DeclarationError(Exception):
    """One error in a declaration: its place, what is wrong and a hint."""

    def __init__(self, span: Span, message: str, hint: str | None = None, *, id: str) -> None:
        super().__init__(message)
        self.span, self.message, self.hint, self.id = span, message, hint, id


def read_declaration(tree: Node, line: Line, package: str, diagnostics: Diagnostics) -> Declaration | None:
    """Return what `tree` declares, or None with errors in `diagnostics`; `package` is that of the file."""
    if is_unsigned_of_c(line.text):  # two words are the type: the second one is no name
        with _reported(diagnostics):
            _field_type(tree.children[0], line, package)
        return None
    if tree.data == "constant":
        return _constant(tree, line, diagnostics)
    return _field(tree, line, package, diagnostics)


def _constant(tree: Node, line: Line, diagnostics: Diagnostics) -> Declaration | None:
    type_node, name, *rest = tree.children
    kind, name_ok = None, False
    with _reported(diagnostics):
        kind = _constant_type(type_node, line)
    with _reported(diagnostics):
        name_ok = _check_name(name, line, msg_names.constant_name_fault)
    if kind is None or not name_ok:
        return None
    warning = msg_names.constant_name_warning(str(name))
    if warning is not None:
        diagnostics.warning(warning.message, line.span_of(name), warning.hint, id=warning.id)
    with _reported(diagnostics):
        value = _scalar(kind, rest[0] if rest else None, line, diagnostics)
        return Declaration(Constant(str(name), kind, value, span=_whole(line, name)), line.span_of(name))
    return None


def _field(tree: Node, line: Line, package: str, diagnostics: Diagnostics) -> Declaration | None:
    type_node, name, *rest = tree.children
    field_type, name_ok = None, False
    with _reported(diagnostics):
        _check_no_equal(line)
        name_ok = _check_name(name, line, msg_names.field_name_fault)
    with _reported(diagnostics):
        field_type = _field_type(type_node, line, package)
    if field_type is None or not name_ok:
        return None
    warning = msg_names.field_name_warning(str(name))
    if warning is not None:
        diagnostics.warning(warning.message, line.span_of(name), warning.hint, id=warning.id)
    with _reported(diagnostics):
        default = _default(field_type, rest[0], line, diagnostics) if rest else None
        field_type = _as_jazzy_reads(field_type, line, diagnostics)
        warning = None if default is None else msg_names.value_warning(field_type, default)
        if warning is not None:
            place = line.span(line.text.rindex("[") + 1, len(line.text) + 1)
            diagnostics.warning(warning.message, place, warning.hint, id=warning.id)
        return Declaration(Field(str(name), field_type, default, span=_whole(line, name)), line.span_of(name))
    return None


@contextmanager
def _reported(diagnostics: Diagnostics) -> Iterator[None]:
    """Turn the error of one part into a diagnostic and go on."""
    try:
        yield
    except _DeclarationError as fault:
        diagnostics.error(fault.message, fault.span, fault.hint, id=fault.id)


def _whole(line: Line, name: Word) -> Span:
    """Return the place of a declaration: type and name."""
    return line.span(1, _column(name) + len(name))


def _check_name(name: Word, line: Line, fault_of: Callable[[str], Fault | None]) -> bool:
    fault = fault_of(str(name))
    if fault is not None:
        raise _DeclarationError(line.span_of(name), fault.message, fault.hint, id=fault.id)
    return True


def _field_type(node: Node, line: Line, package: str) -> FieldType:
    if node.data != "array":
        return _element_type(node, line, package)
    element_node, extent = node.children
    element = _element_type(element_node, line, package)
    if extent.data == "unbounded":
        return SequenceType(element)
    size = _bound(
        _token(extent), line, "the size of an array" if extent.data == "fixed" else "the bound of a sequence"
    )
    return ArrayType(element, size) if extent.data == "fixed" else SequenceType(element, size)


def _constant_type(node: Node, line: Line) -> Primitive | StringType:
    start = _token(node)
    if node.data == "array":
        raise _DeclarationError(
            line.span_of(start),
            "a constant cannot be an array",
            "Declare one constant for each element",
            id="MG-2107",
        )
    if node.data == "string" and len(node.children) > 1:
        raise _DeclarationError(
            line.span_of(start),
            "the type of a constant cannot have a bound",
            f"Write '{start}'",
            id="MG-2108",
        )
    element = _element_type(node, line, "")
    if isinstance(element, NamedType):
        raise _DeclarationError(
            line.span_of(start),
            "a constant has a primitive type or is a string",
            "Use another type",
            id="MG-2109",
        )
    return element


def _element_type(node: Node, line: Line, package: str) -> ElementType:
    if node.data == "primitive":
        return _PRIMITIVES[str(node.children[0])]
    if node.data == "string":
        wide = node.children[0] == "wstring"
        if len(node.children) == 1:
            return StringType(wide)
        return StringType(wide, _bound(node.children[1], line, "the bound of a string"))
    return NamedType(_type_name(node.children, line, package))


def _type_name(parts: Sequence[Word], line: Line, package: str) -> TypeName:
    first, last = parts[0], parts[-1]
    span = line.span(_column(first), _column(last) + len(last))
    written = "/".join(parts)
    if len(parts) > 2:
        raise _DeclarationError(
            span, f"'{written}' is not a type", f"Write '{parts[0]}/{parts[-1]}'", id="MG-2110"
        )
    if written in _ONCE_PRIMITIVE:
        raise _DeclarationError(
            span, f"'{written}' is not a type of ROS 2", f"Write '{_ONCE_PRIMITIVE[written]}'", id="MG-2111"
        )
    if len(parts) == 2:
        fault = msg_names.package_name_fault(str(first))
        if fault is not None:
            raise _DeclarationError(line.span_of(first), fault.message, id=fault.id)
        package = str(first)
    fault = msg_names.type_name_fault(str(last))
    if fault is not None:
        hint = type_hint(str(last), line.text, _PRIMITIVES) if len(parts) == 1 else None
        raise _DeclarationError(span, fault.message, hint, id=fault.id)
    return TypeName(package, "msg", str(last))


def _bound(token: Word, line: Line, what: str) -> int:
    number = positive_integer(str(token))
    any_number = "'string' takes any length" if "string" in what else "'[]' takes any number of elements"
    if number is None:
        hint = "Write '<=N' for at most N elements" if token[0] in "<>" else f"Leave it out: {any_number}"
        raise _DeclarationError(
            line.span_of(token), f"{what} is a whole number above zero, not '{token}'", hint, id="MG-2114"
        )
    if number > LARGEST_BOUND:
        hint = f"Write {LARGEST_BOUND}, or leave it out: {any_number}"
        raise _DeclarationError(
            line.span_of(token), f"{what} is at most {LARGEST_BOUND}, not {number}", hint, id="MG-2115"
        )
    return number


def _default(field_type: FieldType, node: Node | Word, line: Line, diagnostics: Diagnostics) -> Value:
    if isinstance(field_type, (Primitive, StringType)):
        assert isinstance(node, Word)
        return _scalar(field_type, node, line, diagnostics)
    if isinstance(field_type, NamedType) or isinstance(field_type.element, NamedType):
        assert isinstance(node, Word)
        raise _DeclarationError(
            line.span_of(node), "a field of a message type cannot have a default", "Remove it", id="MG-2116"
        )
    assert isinstance(node, Node)  # the grammar has no other default for these arrays
    values = _elements(field_type.element, node.children, line)
    _check_count(field_type, len(values), line)
    return values


def _check_no_equal(line: Line) -> None:
    _, _, rest = line.text.partition(" ")
    if "=" in rest:
        column = len(line.text) - len(rest) + rest.index("=") + 1
        raise _DeclarationError(
            line.span(column, column + 1),
            "a default cannot hold '=': ROS 2 takes this line for a constant",
            "A constant is written 'type NAME=value'",
            id="MG-2117",
        )


def _scalar(
    kind: Primitive | StringType, node: Word | None, line: Line, diagnostics: Diagnostics
) -> ScalarValue:
    """Return the value of a constant or default; `node` is None where nothing follows the `=`."""
    if node is None:
        if isinstance(kind, StringType):
            return ""
        raise _DeclarationError(
            line.span(len(line.text) + 1, 0),
            "the constant has no value",
            "Write it after the '='",
            id="MG-2118",
        )
    text = str(node)
    try:
        value = scalar_value(kind, text)
    except InvalidValueError as fault:
        raise _DeclarationError(line.span_of(node), fault.message, fault.hint, id=fault.id) from None
    if isinstance(kind, StringType) and text[0] in "\"'" and (text[-1] != text[0] or text in "\"'"):
        reason = "The '#' begins a comment, even in quotes" if line.commented else "Close it"
        diagnostics.warning(
            f"the quote is not closed: the text is {value!r}", line.span_of(node), reason, id="MG-2017"
        )
    return value


def _elements(kind: ElementType, tokens: Sequence[Word], line: Line) -> tuple[ScalarValue, ...]:
    if isinstance(kind, StringType):
        try:
            return string_elements(kind, [str(token) for token in tokens])
        except InvalidValueError as fault:
            raise _DeclarationError(_over(tokens, line), fault.message, fault.hint, id=fault.id) from None
    assert isinstance(kind, Primitive)
    values = []
    for token in tokens:
        try:
            values.append(primitive_value(kind, token.strip()))
        except InvalidValueError as fault:
            raise _DeclarationError(line.span_of(token), fault.message, fault.hint, id=fault.id) from None
    return tuple(values)


def _over(tokens: Sequence[Word], line: Line) -> Span:
    first, last = line.span_of(tokens[0]), line.span_of(tokens[-1])
    return line.span(first.column, last.end_column or last.column + 1)


def _check_count(field_type: ArrayType | SequenceType, count: int, line: Line) -> None:
    span = line.span(len(line.text), len(line.text) + 1)
    if isinstance(field_type, ArrayType):
        if count != field_type.size:
            raise _DeclarationError(
                span,
                f"the default has {count} elements, but the array has {field_type.size}",
                f"Write {field_type.size} values, or '[{count}]' after the type",
                id="MG-2122",
            )
    elif field_type.bound is not None and count > field_type.bound:
        raise _DeclarationError(
            span,
            f"the default has {count} elements, but the sequence takes at most {field_type.bound}",
            f"Write fewer, or '[<={count}]' after the type",
            id="MG-2123",
        )


def _as_jazzy_reads(field_type: FieldType, line: Line, diagnostics: Diagnostics) -> FieldType:
    """Return the type that Jazzy's rosidl_parser derives from it.

        It takes the bound of a wide string for the bound of the sequence around it if that has no
    bound, so the type hash and every peer have the bounded sequence.
    """
    if not isinstance(field_type, SequenceType) or field_type.bound is not None:
        return field_type
    element = field_type.element
    if not isinstance(element, StringType) or not element.wide or element.bound is None:
        return field_type
    diagnostics.warning(
        f"ROS 2 Jazzy reads wstring<={element.bound}[] as a sequence of at most {element.bound} elements",
        line.span(1, line.text.index(" ") + 1),
        f"Write wstring<={element.bound}[<=N] with the number of elements that you mean",
        id="MG-2018",
    )
    return SequenceType(element, element.bound)


def _token(node: Node) -> Word:
    """Return the first token below `node`."""
    first: Any = node
    while isinstance(first, Node):
        first = first.children[0]
    token: Word = first
    return token


def _column(token: Word) -> int:
    return token.column or 1
