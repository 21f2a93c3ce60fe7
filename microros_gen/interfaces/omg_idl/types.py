# SPDX-License-Identifier: Apache-2.0
"""Types of .idl files: from the syntax tree to the types of the model, typedefs resolved as ROS 2 Jazzy does.

rosidl_parser knows typedefs by their bare name, wherever they are in the file, and looks through one of them
(through a second one below an array or a sequence). Enumerations are read and no member can be of one.
"""

from __future__ import annotations

from dataclasses import field

from lark import Token

from microros_gen.diagnostics import Diagnostics, Source, Span, nearest
from microros_gen.interfaces.msg.names import package_name_fault
from microros_gen.interfaces.msg.syntax import SyntaxNode
from microros_gen.interfaces.omg_idl.values import IdlError, first_token, positive_bound, span_of
from microros_gen.interfaces.types import (
    ArrayType,
    ElementType,
    FieldType,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
)
from microros_gen.records import dataclass

KINDS = ("msg", "srv", "action")
"""The kinds of interfaces, which are names of modules too."""

_BASES = {
    "boolean": Primitive.BOOL,
    "octet": Primitive.BYTE,
    "char": Primitive.IDL_CHAR,
    "wchar": Primitive.WCHAR,
    "float": Primitive.FLOAT32,
    "double": Primitive.FLOAT64,
    "short": Primitive.INT16,
    "long": Primitive.INT32,
    "long long": Primitive.INT64,
    "unsigned short": Primitive.UINT16,
    "unsigned long": Primitive.UINT32,
    "unsigned long long": Primitive.UINT64,
    **{p.value: p for p in (Primitive.INT8, Primitive.INT16, Primitive.INT32, Primitive.INT64)},
    **{p.value: p for p in (Primitive.UINT8, Primitive.UINT16, Primitive.UINT32, Primitive.UINT64)},
}
_OTHER_LANGUAGES = {
    "bool": "boolean",
    "byte": "octet",
    "float32": "float",
    "float64": "double",
    "int": "int32",
    "any": "a struct of your own",
    "Object": "a struct of your own",
}


@dataclass(frozen=True)
class Alias:
    """A bare name: that of a typedef."""

    name: str
    span: Span = field(compare=False)


@dataclass(frozen=True)
class Written:
    """A type as it is written: one element, or an array or a sequence of it."""

    element: ElementType | Alias
    size: int | None = None
    sequence: bool = False
    bound: int | None = None

    @property
    def nested(self) -> bool:
        """Whether it is an array or a sequence."""
        return self.sequence or self.size is not None


@dataclass
class Scope:
    """What the types of a file can refer to.

    `modules` are package and kind; `broken` are the words of declarations that have an error: names among them
    are not reported again.
    """

    source: Source
    diagnostics: Diagnostics
    modules: tuple[str, str]
    constants: dict[str, SyntaxNode] = field(default_factory=dict)
    typedefs: dict[str, Written] = field(default_factory=dict)
    typedef_names: set[str] = field(default_factory=set)
    enumerations: set[str] = field(default_factory=set)
    broken: set[str] = field(default_factory=set)


def written_type(node: SyntaxNode, scope: Scope) -> Written:
    """Return the type that `node` writes. Raises IdlError."""
    if node.data != "sequence":
        return Written(_element(node, scope))
    element_node = node.children[1]
    if element_node.data == "sequence":
        raise IdlError(
            span_of(element_node, scope.source),
            "ROS 2 has no sequence of sequences",
            "Put the inner one into a separate struct",
            id="MG-2067",
        )
    element = _element(element_node, scope)
    if len(node.children) > 2:
        bound = positive_bound(node.children[2], "the bound of a sequence", scope.constants, scope.source)
        return Written(element, sequence=True, bound=bound)
    return Written(element, sequence=True, bound=_bound_in_jazzy(element, element_node, scope))


def declared_type(written: Written, declarator: SyntaxNode, scope: Scope) -> Written:
    """Return the type of `declarator`: an array of `written` when it has a size. Raises IdlError."""
    sizes = declarator.children[1:]
    if not sizes:
        return written
    span = span_of(declarator, scope.source)
    if len(sizes) > 1:
        raise IdlError(
            span,
            "ROS 2 has arrays of one dimension only",
            "Put the inner one into a separate struct",
            id="MG-2068",
        )
    if written.nested:
        raise IdlError(
            span, "ROS 2 has no array of sequences", "Put the sequence into a separate struct", id="MG-2069"
        )
    size = positive_bound(sizes[0], "the size of an array", scope.constants, scope.source)
    return Written(written.element, size=size)


def resolved(written: Written, scope: Scope) -> FieldType | None:
    """Return the type with typedefs resolved; None when it refers to a declaration with an error.

    Raises IdlError.
    """
    if not isinstance(written.element, Alias):
        return _model_type(written, written.element)
    alias = written.element
    target = _target(alias, scope)
    if target is None:
        return None
    if written.nested and target.nested:
        raise IdlError(
            alias.span,
            f"'{alias.name}' is an array or a sequence itself: ROS 2 Jazzy generates no C code for this",
            "Put it into a separate struct",
            id="MG-2070",
        )
    if isinstance(target.element, Alias):
        if not target.nested:
            raise IdlError(
                alias.span,
                f"'{alias.name}' is a typedef of a typedef: ROS 2 Jazzy generates no C code for this",
                f"Write '{target.element.name}'",
                id="MG-2071",
            )
        element = _second(alias, target.element, scope)
        return None if element is None else _model_type(target, element)
    return _model_type(written if written.nested else target, target.element)


def _second(alias: Alias, inner: Alias, scope: Scope) -> ElementType | None:
    target = _target(inner, scope)
    if target is None:
        return None
    if target.nested or isinstance(target.element, Alias):
        raise IdlError(
            alias.span,
            f"'{alias.name}' is a typedef of '{inner.name}', which is not a single element: ROS 2 Jazzy generates"
            " no C code for it",
            "Put it into a separate struct",
            id="MG-2072",
        )
    return target.element


def _target(alias: Alias, scope: Scope) -> Written | None:
    if alias.name in scope.typedefs:
        return scope.typedefs[alias.name]
    if alias.name in scope.broken:
        return None
    if alias.name in scope.enumerations:
        raise IdlError(
            alias.span,
            f"'{alias.name}' is an enumeration: ROS 2 reads enumerations but generates no type for them",
            "Use uint8 and constants in a module that ends with '_Constants'",
            id="MG-2073",
        )
    raise IdlError(
        alias.span,
        f"'{alias.name}' is neither a type nor a typedef of this file",
        _type_hint(alias.name, scope),
        id="MG-2074",
    )


def _type_hint(name: str, scope: Scope) -> str | None:
    if name in _OTHER_LANGUAGES:
        return f"Write {_OTHER_LANGUAGES[name]}"
    suggestion = nearest(name, [*scope.typedefs, *_BASES, "string", "wstring"])
    if name[0].isupper() and (
        suggestion is None or suggestion.strip("?'").rpartition("'")[2] not in scope.typedefs
    ):
        return f"Another interface is written '{scope.modules[0]}::msg::{name}'"
    return suggestion or (
        "Write a type of IDL (boolean, octet, int32, double, string), a typedef above it, or another "
        f"interface with its package ('{scope.modules[0]}::msg::Name')"
    )


def _model_type(written: Written, element: ElementType) -> FieldType:
    if written.size is not None:
        return ArrayType(element, written.size)
    return SequenceType(element, written.bound) if written.sequence else element


def _element(node: SyntaxNode, scope: Scope) -> ElementType | Alias:
    if node.data == "base":
        return _base(node, scope.source)
    if node.data == "string":
        wide = node.children[0].type == "WSTRING_TYPE"
        if len(node.children) == 1:
            return StringType(wide)
        bound = positive_bound(node.children[1], "the bound of a string", scope.constants, scope.source)
        return StringType(wide, bound)
    if node.data == "name":
        return _name(node, scope)
    raise IdlError(
        span_of(node, scope.source),
        "ROS 2 has no fixed-point type",
        "Use double, or an integer and a scale",
        id="MG-2075",
    )


def _base(node: SyntaxNode, source: Source) -> Primitive:
    words = " ".join(node.children)
    if words == "long double":
        raise IdlError(
            span_of(node, source),
            "ROS 2 Jazzy cannot describe a long double: its type description has no name for it",
            "Use double",
            id="MG-2076",
        )
    return _BASES[words]


def _name(node: SyntaxNode, scope: Scope) -> NamedType | Alias:
    parts = [str(token) for token in node.children if token.type == "IDENTIFIER"]
    span = _name_span(node.children, scope.source)
    absolute = len(node.children) > 0 and node.children[0].type == "SCOPE"
    if len(parts) == 1 and not absolute:
        return Alias(parts[0], span)
    written = "::".join(parts)
    if len(parts) != 3 or parts[1] not in KINDS:
        hint = f"Write '{parts[-1]}'" if parts[-1] in scope.typedef_names else "Write 'package::msg::Name'"
        raise IdlError(span, f"'{written}' is not the full name of an interface", hint, id="MG-2077")
    if (*scope.modules, parts[2]) == tuple(parts) and parts[2] in scope.typedef_names | scope.enumerations:
        raise IdlError(
            span,
            f"'{written}' is not a struct, and ROS 2 Jazzy finds no file for it",
            f"Write '{parts[2]}'" if parts[2] in scope.typedef_names else "Use an integer and constants",
            id="MG-2078",
        )
    fault = package_name_fault(parts[0])
    if fault is not None:
        raise IdlError(span, fault.message, id=fault.id)
    return NamedType(TypeName(parts[0], parts[1], parts[2]))


def _name_span(tokens: list[Token], source: Source) -> Span:
    first, last = tokens[0], tokens[-1]
    end = (last.column or 1) + len(last) if last.line == first.line else (first.column or 1) + len(first)
    return Span(source, first.line or 1, first.column or 1, end)


def _bound_in_jazzy(element: ElementType | Alias, node: SyntaxNode, scope: Scope) -> int | None:
    """Return the bound of a sequence that is written without one.

    rosidl_parser takes that of a wide string in it, so the type hash and every peer have the bounded sequence.
    """
    if not isinstance(element, StringType) or not element.wide or element.bound is None:
        return None
    scope.diagnostics.warning(
        f"ROS 2 Jazzy reads this as a sequence of at most {element.bound} elements: the bound of its strings",
        span_of(first_token(node), scope.source),
        f"Write sequence<wstring<{element.bound}>, N> with the number of elements that you mean",
        id="MG-2057",
    )
    return element.bound
