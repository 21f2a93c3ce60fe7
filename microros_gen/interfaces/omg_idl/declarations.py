# SPDX-License-Identifier: Apache-2.0
"""From the syntax tree of an .idl file to the messages that it declares, with every check of their parts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import field

from lark import Token

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.interfaces.msg.fault import Fault
from microros_gen.interfaces.msg.names import (
    C_KEYWORDS,
    CPP_KEYWORDS,
    constant_name_warning,
    field_name_warning,
    value_warning,
)
from microros_gen.interfaces.msg.syntax import SyntaxNode
from microros_gen.interfaces.omg_idl.annotations import Annotations, read_annotations
from microros_gen.interfaces.omg_idl.syntax import Syntax
from microros_gen.interfaces.omg_idl.types import Scope, Written, declared_type, resolved, written_type
from microros_gen.interfaces.omg_idl.values import (
    IdlError,
    checked_default,
    checked_scalar,
    literal_value,
    span_of,
)
from microros_gen.interfaces.type_description import EMPTY_MEMBER
from microros_gen.interfaces.types import (
    Constant,
    Field,
    FieldType,
    Message,
    Primitive,
    StringType,
    TypeName,
    Value,
    element_of,
)
from microros_gen.records import dataclass

CONSTANTS_SUFFIX = "_Constants"
"""A module `Name_Constants` holds the constants of the struct `Name` (rosidl)."""


@dataclass(frozen=True)
class Placed:
    """A declaration and the modules around it, from the outermost."""

    node: SyntaxNode
    modules: tuple[str, ...]

    @property
    def name(self) -> Token:
        """The token of its name."""
        tokens = (child for child in self.node.children if isinstance(child, Token))
        return next(tokens)


@dataclass
class Contents:
    """The declarations of a file by what they are, each list in the order of the file."""

    includes: list[Token] = field(default_factory=list)
    structs: list[Placed] = field(default_factory=list)
    constants: list[Placed] = field(default_factory=list)
    typedefs: list[Placed] = field(default_factory=list)
    enumerations: list[Placed] = field(default_factory=list)
    forwards: list[Placed] = field(default_factory=list)
    modules: list[Placed] = field(default_factory=list)


def contents_of(tree: SyntaxNode) -> Contents:
    """Return what stands in a file, at every depth."""
    found = Contents()
    lists = {
        "struct": found.structs,
        "constant": found.constants,
        "typedef": found.typedefs,
        "enumeration": found.enumerations,
        "forward": found.forwards,
    }
    pending: list[Placed] = [Placed(node, ()) for node in reversed(tree.children)]
    while pending:
        placed = pending.pop()
        node = placed.node
        if node.data == "include":
            found.includes.append(node.children[0])
        elif node.data == "module":
            inside = (*placed.modules, str(node.children[1]))
            pending.extend(Placed(child, inside) for child in reversed(node.children[2:]))
            found.modules.append(placed)
        else:
            lists[node.data].append(placed)
    return found


def scope_of(contents: Contents, syntax: Syntax, source: Source, scope: Scope) -> None:
    """Fill `scope` with the names that types and values can refer to, and check typedefs."""
    scope.broken.update(_words(syntax.lost))
    scope.constants.update((str(c.name), c.node.children[-1]) for c in contents.constants)
    scope.enumerations.update(str(e.name) for e in contents.enumerations)
    scope.typedef_names.update(str(t.node.children[1].children[0]) for t in contents.typedefs)
    for placed in contents.typedefs:
        name = str(placed.node.children[1].children[0])
        try:
            written = _typedef(placed.node, scope, source)
        except IdlError as error:
            scope.broken.add(name)
            scope.diagnostics.error(error.message, error.span, error.hint, id=error.id)
            continue
        if scope.typedefs.setdefault(name, written) != written:
            span = span_of(placed.node.children[1], source)
            scope.diagnostics.error(
                f"'{name}' is already declared as another type",
                span,
                "ROS 2 knows typedefs by their name alone: rename one",
                id="MG-2031",
            )


def message_of(placed: Placed, constants: Sequence[Placed], name: TypeName, scope: Scope) -> Message:
    """Return the message that a struct declares; what has an error is left out and reported."""
    source = scope.source
    annotations = Annotations()
    with reported(scope.diagnostics):
        known_only = name.kind != "msg"
        annotations = read_annotations(
            placed.node.children[0], scope.constants, source, known_only=known_only
        )
    members = [Placed(node, placed.modules) for node in placed.node.children[2:]]
    fields = [element for member in members for element in _fields(member.node, scope)]
    values = [c for constant in constants if (c := _constant(constant.node, scope)) is not None]
    if not members and not scope.broken:
        scope.diagnostics.error(
            f"the struct '{placed.name}' has no member",
            span_of(placed.name, source),
            f"ROS 2 writes 'uint8 {EMPTY_MEMBER};'",
            id="MG-2032",
        )
    _check_duplicates([*values, *fields], scope.diagnostics)
    if [(f.name, f.type) for f in fields] == [(EMPTY_MEMBER, Primitive.UINT8)]:
        fields = []
    return Message(name, tuple(fields), tuple(values), annotations.comment, span_of(placed.name, source))


@contextmanager
def reported(diagnostics: Diagnostics) -> Iterator[None]:
    """Turn the error of one part into a diagnostic and go on."""
    try:
        yield
    except IdlError as error:
        diagnostics.error(error.message, error.span, error.hint, id=error.id)


def name_fault(name: str) -> Fault | None:
    """Return what is wrong with a name of an .idl file and a hint, or None: a keyword compiles nowhere."""
    language = "C" if name in C_KEYWORDS else "C++" if name in CPP_KEYWORDS else None
    if language is None:
        return None
    return Fault(
        f"'{name}' is a keyword of {language}, so nothing can have this name",
        hint=f"For example '{name}_value'",
        id="MG-2037",
    )


def _words(text: str) -> set[str]:
    return set("".join(c if c.isalnum() or c == "_" else " " for c in text).split())


def _typedef(node: SyntaxNode, scope: Scope, source: Source) -> Written:
    type_node, declarator, *more = node.children
    if more:
        raise IdlError(
            span_of(more[0], source), "a typedef declares one name", "Write a second typedef", id="MG-2064"
        )
    return declared_type(written_type(type_node, scope), declarator, scope)


def _fields(node: SyntaxNode, scope: Scope) -> Iterator[Field]:
    annotations_node, type_node, *declarators = node.children
    annotations: Annotations | None = None
    written: Written | None = None
    with reported(scope.diagnostics):
        annotations = read_annotations(annotations_node, scope.constants, scope.source)
    with reported(scope.diagnostics):
        written = written_type(type_node, scope)
    for declarator in declarators:
        name_ok = _check_name(declarator.children[0], scope)
        if annotations is None or written is None or not name_ok:
            continue
        with reported(scope.diagnostics):
            before, written = written, declared_type(written, declarator, scope)
            if written is before and before.size is not None and declarator is not declarators[0]:
                _warn_of_size(declarator, before.size, scope)
            element = _field(declarator, written, annotations, scope)
            if element is not None:
                yield element


def _field(declarator: SyntaxNode, written: Written, annotations: Annotations, scope: Scope) -> Field | None:
    field_type = resolved(written, scope)
    if field_type is None:
        return None
    span = span_of(declarator, scope.source)
    _check_type_support(field_type, span)
    default = annotations.default
    value: Value | None = None
    if default is not None:
        value = checked_default(field_type, default.value, default.span)
        _warn_of_value(field_type, value, default.span, scope)
    return Field(str(declarator.children[0]), field_type, value, annotations.comment, span)


def _check_type_support(field_type: FieldType, span: Span) -> None:
    """Refuse what rosidl_typesupport_fastrtps_c stops at, so that no package of ROS 2 Jazzy can have it."""
    if element_of(field_type) is Primitive.WCHAR and field_type is not Primitive.WCHAR:
        raise IdlError(
            span,
            "ROS 2 Jazzy has single members of type wchar only: its type support for C stops at an array or a "
            "sequence of them",
            "Use uint16, which has the same bytes, or wstring for text",
            id="MG-2065",
        )


def _warn_of_value(kind: FieldType, value: Value, span: Span, scope: Scope) -> None:
    warning = value_warning(kind, value)
    if warning is not None:
        scope.diagnostics.warning(warning.message, span, warning.hint, id=warning.id)


def _warn_of_size(declarator: SyntaxNode, size: int, scope: Scope) -> None:
    """Say what rosidl_parser does: after a declarator with a size, all others of the line have it too."""
    scope.diagnostics.warning(
        f"ROS 2 Jazzy also makes '{declarator.children[0]}' an array of {size}",
        span_of(declarator, scope.source),
        "Write it as a separate member",
        id="MG-2035",
    )


def _constant(node: SyntaxNode, scope: Scope) -> Constant | None:
    annotations_node, type_node, name, value_node = node.children
    source = scope.source
    annotations = Annotations()
    with reported(scope.diagnostics):
        annotations = read_annotations(annotations_node, scope.constants, source)
    with reported(scope.diagnostics):
        kind = _constant_type(type_node, scope)
        value = literal_value(value_node, scope.constants, source)
        checked = checked_scalar(kind, value, span_of(value_node, source))
        _warn_of_value(kind, checked, span_of(value_node, source), scope)
        if isinstance(kind, StringType):
            kind = StringType(kind.wide)
        if _check_name(name, scope):
            warning = constant_name_warning(str(name))
            if warning is not None:
                scope.diagnostics.warning(warning.message, span_of(name, source), warning.hint, id=warning.id)
            return Constant(str(name), kind, checked, annotations.comment, span_of(name, source))
    return None


def _constant_type(node: SyntaxNode, scope: Scope) -> Primitive | StringType:
    if node.data in ("base", "string"):
        element = written_type(node, scope).element
        if isinstance(element, (Primitive, StringType)):
            return element
    raise IdlError(
        span_of(node, scope.source),
        "a constant has a basic type or is a string",
        "ROS 2 Jazzy does not resolve typedefs here: write the type itself",
        id="MG-2066",
    )


def _check_name(name: Token, scope: Scope) -> bool:
    span = span_of(name, scope.source)
    fault = name_fault(str(name))
    if fault is not None:
        scope.diagnostics.error(fault.message, span, fault.hint, id=fault.id)
        return False
    warning = field_name_warning(str(name))
    if warning is not None:
        scope.diagnostics.warning(warning.message, span, warning.hint, id=warning.id)
    return True


def _check_duplicates(elements: Sequence[Constant | Field], diagnostics: Diagnostics) -> None:
    first: dict[str, Span | None] = {}
    for element in elements:
        if element.name not in first:
            first[element.name] = element.span
            continue
        earlier = first[element.name]
        hint = f"Line {earlier.line} has it first" if earlier else None
        diagnostics.error(f"the name '{element.name}' is declared twice", element.span, hint, id="MG-2039")
