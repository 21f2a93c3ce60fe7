# SPDX-License-Identifier: Apache-2.0
"""Reads .idl files as ROS 2 Jazzy does (rosidl_parser and the generators that use it).

ROS 2 takes one interface a file: a struct `Name` is a message, two (`Name_Request`, `Name_Response`) are a
service, three (`Name_Goal`, `Name_Result`, `Name_Feedback`) an action. Constants of a struct stand in a module
`Name_Constants`. What rosidl_parser takes and no C can be made of is an error here too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from microros_gen.diagnostics import Diagnostics, Source, Span, reads
from microros_gen.interfaces.derived import ACTION_PARTS, SERVICE_PARTS, make_declaration
from microros_gen.interfaces.msg.names import interface_name_warning, package_name_fault
from microros_gen.interfaces.omg_idl.declarations import (
    CONSTANTS_SUFFIX,
    Contents,
    Placed,
    contents_of,
    message_of,
    name_fault,
    scope_of,
)
from microros_gen.interfaces.omg_idl.syntax import parse_syntax
from microros_gen.interfaces.omg_idl.types import KINDS, Scope
from microros_gen.interfaces.omg_idl.values import span_of, tokens_of
from microros_gen.interfaces.types import Declaration, Message, TypeName
from microros_gen.records import dataclass

_BYTE_ORDER_MARK = "\ufeff"
_PARTS: Mapping[str, tuple[str, ...]] = {"msg": ("",), "srv": SERVICE_PARTS, "action": ACTION_PARTS}
_DECLARED_BY = {1: "msg", 2: "srv", 3: "action"}
_INTERFACE = {"msg": "a message", "srv": "a service", "action": "an action"}


@dataclass(frozen=True)
class Include:
    """The path of an `#include` as it is written, without its quotes; `span` is the whole line's."""

    path: str
    span: Span


@dataclass(frozen=True)
class IdlFile:
    """What an .idl file holds: `declarations` has one element, or none when there was an error."""

    declarations: tuple[Declaration, ...]
    includes: tuple[Include, ...]


def parse_idl(source: Source, package: str, kind: str, diagnostics: Diagnostics) -> tuple[Declaration, ...]:
    """Return the message, service or action that `source` declares; nothing when it has an error.

    `package` and `kind` (msg, srv or action) are those of its folder, and its modules have to say the same.
    Every error and warning goes to `diagnostics`, with its line and columns. Members of other interfaces'
    types are named and not looked up.
    """
    return read_idl(source, package, kind, diagnostics).declarations


@reads
def read_idl(source: Source, package: str, kind: str, diagnostics: Diagnostics) -> IdlFile:
    """Return what `parse_idl` returns, and the files that `source` includes, which are not read."""
    found = Diagnostics()
    source = _checked_source(source, package, kind, found)
    syntax = parse_syntax(source, found)
    declarations: tuple[Declaration, ...] = ()
    includes: tuple[Include, ...] = ()
    if syntax is not None:
        contents = contents_of(syntax.tree)
        includes = tuple(
            Include(str(t).split(None, 1)[-1][1:-1], span_of(t, source)) for t in contents.includes
        )
        scope = Scope(source, found, (package, kind))
        scope_of(contents, syntax, source, scope)
        declarations = _declarations(contents, scope)
    diagnostics.extend(found)
    return IdlFile(() if found.has_errors() else declarations, includes)


def _checked_source(source: Source, package: str, kind: str, diagnostics: Diagnostics) -> Source:
    text = source.text.replace("\r\n", "\n").replace("\r", "\n")
    if text.startswith(_BYTE_ORDER_MARK):
        text = text[1:]
        hint = "ROS 2 refuses it: save as UTF-8 without it"
        diagnostics.warning("the file begins with a byte order mark", Span(source, 1, 1), hint, id="MG-2040")
    if text != source.text:
        source = Source(source.name, text)
    fault = package_name_fault(package)
    if fault is not None:
        hint = "ROS 2 accepts no other names for folders of interfaces"
        diagnostics.error(fault.message, Span(source, 1, 1), hint, id=fault.id)
    if kind not in KINDS:
        diagnostics.error(
            f"'{kind}' is not a folder of interfaces",
            Span(source, 1, 1),
            "They are msg, srv and action",
            id="MG-2042",
        )
    return source


def _declarations(contents: Contents, scope: Scope) -> tuple[Declaration, ...]:
    _check_surroundings(contents, scope)
    structs = contents.structs
    constants = _constants_by_struct(contents, scope)
    messages = [
        message_of(
            struct, constants.get(str(struct.name), ()), TypeName(*scope.modules, str(struct.name)), scope
        )
        for struct in structs
    ]
    stem = _stem(structs, scope)
    if stem is None:
        return ()
    warning = interface_name_warning(stem, [part for part in _PARTS[scope.modules[1]] if part])
    if warning is not None:
        scope.diagnostics.warning(
            warning.message, span_of(structs[0].name, scope.source), warning.hint, id=warning.id
        )
    return (_declaration(TypeName(*scope.modules, stem), messages, scope.source),)


def _declaration(name: TypeName, messages: Sequence[Message], source: Source) -> Declaration:
    if name.kind == "msg":
        return messages[0]
    return make_declaration(name, tuple(messages), messages[0].comment, Span(source, 1, 1))


def _check_surroundings(contents: Contents, scope: Scope) -> None:
    """Check the modules of each struct, its name, and what else is in the file."""
    source, diagnostics = scope.source, scope.diagnostics
    for struct in contents.structs:
        span = span_of(struct.name, source)
        if struct.modules != scope.modules:
            found = "::".join(struct.modules) or "no module"
            diagnostics.error(
                f"the struct '{struct.name}' is in {found}, its file in {'/'.join(scope.modules)}",
                span,
                f"Write it in module {scope.modules[0]} {{ module {scope.modules[1]} {{ … }}; }};",
                id="MG-2044",
            )
        fault = name_fault(str(struct.name))
        if fault is not None:
            diagnostics.error(fault.message, span, fault.hint, id=fault.id)
    for forward in contents.forwards:
        if forward.node.children[0].children:
            diagnostics.error(
                "a forward declaration of a struct takes no annotation",
                span_of(forward.name, source),
                "Put it on the struct itself",
                id="MG-2046",
            )
    for module in contents.modules:
        span = span_of(module.name, source)
        if module.node.children[0].children:
            message = f"ROS 2 Jazzy takes the annotation's name for that of the module '{module.name}'"
            diagnostics.error(message, span, "Write modules without annotations", id="MG-2047")
        if len(module.node.children) == 2 and not scope.broken:
            diagnostics.error(f"the module '{module.name}' is empty", span, "Remove it", id="MG-2048")


def _stem(structs: Sequence[Placed], scope: Scope) -> str | None:
    """Return the name of the interface that these structs make, or None with an error."""
    source, diagnostics, kind = scope.source, scope.diagnostics, scope.modules[1]
    parts = _PARTS.get(kind)
    if parts is None or ("struct" in scope.broken and len(structs) != len(parts)):
        return None
    expected = " and ".join(f"Name_{part}" for part in parts) if kind != "msg" else "one struct"
    if len(structs) != len(parts):
        span = span_of(structs[-1].name, source) if structs else Span(source, 1, 1)
        declared = _INTERFACE.get(_DECLARED_BY.get(len(structs), ""), "no interface")
        many = "one struct" if len(structs) == 1 else f"{len(structs) or 'no'} structs"
        hint = f"Declare {expected}; a struct used by others has its own file"
        diagnostics.error(f"{many} in a file of {kind}/: that is {declared}", span, hint, id="MG-2049")
        return None
    stems = []
    for struct, part in zip(structs, parts, strict=True):
        suffix = f"_{part}" if part else ""
        if not struct.name.endswith(suffix):
            span = span_of(struct.name, source)
            message = f"'{struct.name}' does not end with '{suffix}'"
            diagnostics.error(
                message, span, f"{_INTERFACE[kind].capitalize()} is made of {expected}", id="MG-2050"
            )
            return None
        stems.append(struct.name.removesuffix(suffix))
    for struct, stem in zip(structs, stems, strict=True):
        if stem != stems[0] or not stem:
            message = f"the names before the suffixes differ: '{stems[0]}' and '{stem}'"
            diagnostics.error(message, span_of(struct.name, source), "Give them the same", id="MG-2051")
            return None
    return stems[0]


def _constants_by_struct(contents: Contents, scope: Scope) -> dict[str, list[Placed]]:
    """Return the constants of each struct; report those that no struct gets."""
    structs = {str(struct.name) for struct in contents.structs}
    found: dict[str, list[Placed]] = {}
    for constant in contents.constants:
        span = span_of(constant.name, scope.source)
        if not constant.modules:
            scope.diagnostics.error(
                f"the constant '{constant.name}' is in no module",
                span,
                "Put it into module Name_Constants",
                id="MG-2052",
            )
            continue
        module = constant.modules[-1]
        owner = module.removesuffix(CONSTANTS_SUFFIX)
        if owner == module or owner not in structs:
            scope.diagnostics.warning(
                f"ROS 2 Jazzy ignores the constant '{constant.name}': it belongs to no struct",
                span,
                f"Constants of a struct Name belong in module Name{CONSTANTS_SUFFIX}",
                id="MG-2053",
            )
        found.setdefault(owner, []).append(constant)
    _check_equal_constants(contents.constants, scope)
    return found


def _check_equal_constants(constants: Sequence[Placed], scope: Scope) -> None:
    """Report a constant that two modules declare alike: rosidl_parser gives both to the first module."""
    first: dict[str, list[Placed]] = {}
    for constant in (c for c in constants if c.modules):
        for earlier in first.setdefault(str(constant.name), []):
            if earlier.modules != constant.modules and tokens_of(earlier.node) == tokens_of(constant.node):
                scope.diagnostics.error(
                    f"ROS 2 Jazzy takes '{constant.name}' for a constant of '{earlier.modules[-1]}' too, since "
                    "both are declared in the same way; its C code does not compile",
                    span_of(constant.name, scope.source),
                    "Give one of them another name or comment",
                    id="MG-2054",
                )
        first[str(constant.name)].append(constant)
