# SPDX-License-Identifier: Apache-2.0
"""Reads .msg files, and the parts of .srv and .action files, as ROS 2 Jazzy does (rosidl_adapter and the
readers after it).

Such a text is line oriented: each line is taken apart into declaration and comment here, the grammar
`msg.lark` parses the declaration (the plainest ones `syntax.py`, to the same tree), and what it may say is
checked after that. So every faulty line is reported in one run.
"""

from __future__ import annotations

import re
import textwrap
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache

from microros_gen.diagnostics import Diagnostics, Source, Span, reads
from microros_gen.interfaces.msg.declarations import Declaration, Line, read_declaration
from microros_gen.interfaces.msg.names import package_name_fault, type_name_fault
from microros_gen.interfaces.msg.syntax import Node, plain_declaration
from microros_gen.interfaces.types import Field, Message, TypeName

_BYTE_ORDER_MARK = "\ufeff"


@dataclass
class _Entry:
    """A declaration with the comment lines that belong to it so far."""

    declaration: Declaration
    comment: list[str]


@dataclass
class _Part:
    """What was found in a file, or in one part of it, so far."""

    source: Source
    comment: list[str] = field(default_factory=list)
    entries: list[_Entry] = field(default_factory=list)


@reads
def parse_msg(source: Source, name: TypeName, diagnostics: Diagnostics) -> Message | None:
    """Return the message that `source` declares as type `name`, or None when it has an error.

    Every error and warning goes to `diagnostics`, with its line and columns. Fields of other messages' types
    are named and not looked up.
    """
    found = Diagnostics()
    source = checked_source(source, name.package, (name.name,), found)
    message = parse_part(source, 1, source.text.splitlines(), name, found)
    diagnostics.extend(found)
    return None if found.has_errors() else message


def checked_source(source: Source, package: str, names: Iterable[str], diagnostics: Diagnostics) -> Source:
    """Return `source` without a byte order mark; report that, and names that ROS 2 does not take for
    packages and messages."""
    if source.text.startswith(_BYTE_ORDER_MARK):
        source = Source(source.name, source.text[1:])
        diagnostics.warning(
            "the file begins with a byte order mark",
            Span(source, 1, 1),
            "ROS 2 refuses it: save as UTF-8 without it",
            id="MG-2019",
        )
    for fault in (package_name_fault(package), *map(type_name_fault, names)):
        if fault is not None:
            diagnostics.error(
                fault.message,
                Span(source, 1, 1),
                "ROS 2 takes no other names for folders and files of interfaces",
                id=fault.id,
            )
    return source


def parse_part(
    source: Source, first: int, lines: Sequence[str], name: TypeName, diagnostics: Diagnostics
) -> Message:
    """Return the message that `lines` declare; they begin in line `first` of `source`.

    Faults go to `diagnostics` at their places in `source`; the message lacks what is faulty.
    """
    part = _read_lines(source, first, lines, name, diagnostics)
    _check_duplicates(part.entries, diagnostics)
    return _message(part, name, first)


def _read_lines(
    source: Source, first: int, lines: Sequence[str], name: TypeName, diagnostics: Diagnostics
) -> _Part:
    part = _Part(source)
    pending: list[str] = []
    at_top = True
    # Each tab counts as one space, also inside of strings, so columns stay what they are.
    for number, line in enumerate((line.replace("\t", " ") for line in lines), first):
        _check_comment(source, number, line, diagnostics)
        if at_top and line.startswith("#"):
            part.comment.append(line.lstrip("#"))
            continue
        at_top = False
        text, mark, comment = line.rstrip().partition("#")
        if mark:
            comment = comment.lstrip("#")
            if text and not text.strip():
                # An indented comment continues that of the declaration above it.
                if part.entries:
                    part.entries[-1].comment.append(comment)
                continue
            pending.append(comment)
            text = text.rstrip()
        if not text:
            continue
        declaration = _parse_line(Line(source, number, text, bool(mark)), name.package, diagnostics)
        if declaration is not None:
            part.entries.append(_Entry(declaration, pending))
        pending = []
    return part


def _check_comment(source: Source, number: int, line: str, diagnostics: Diagnostics) -> None:
    """Report a comment that rosidl_adapter stops at: it takes a backslash in it for that of a Python string."""
    before, _, comment = line.rstrip().partition("#")
    if "\\" not in comment:
        return
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of escapes that are none
        try:
            text = comment.encode().decode("unicode_escape")
        except UnicodeDecodeError:
            text = "\n"
    if not re.search(r"[\r\n]|(?<!\\)\\(\\\\)*$", text):
        return
    diagnostics.warning(
        "ROS 2 Jazzy cannot read this comment: it takes the backslash for the start of an escape",
        Span(source, number, len(before) + 1, len(line.rstrip()) + 1),
        "Remove the backslash: ROS 2 generates nothing from the file, microros-gen reads it",
        id="MG-2021",
    )


def _parse_line(line: Line, package: str, diagnostics: Diagnostics) -> Declaration | None:
    tree = _tree(line.text)
    if tree is None:
        from microros_gen.interfaces.msg.grammar import report_syntax

        report_syntax(line, diagnostics)
        return None
    return read_declaration(tree, line, package, diagnostics)


@lru_cache(maxsize=1024)
def _tree(text: str) -> Node | None:
    """Return the syntax of a declaration; packages say `std_msgs/Header header` and `string name` again and again."""
    plain = plain_declaration(text)
    if plain is not None:
        return plain
    # Few lines need it, and to build its tables takes longer than to read hundreds of the others.
    from microros_gen.interfaces.msg.grammar import parse

    return parse(text)


def _check_duplicates(entries: list[_Entry], diagnostics: Diagnostics) -> None:
    first: dict[str, int] = {}
    for entry in entries:
        declaration = entry.declaration
        line = first.setdefault(declaration.name, declaration.name_span.line)
        if line != declaration.name_span.line:
            diagnostics.error(
                f"the name '{declaration.name}' is declared twice",
                declaration.name_span,
                f"Line {line} has it first",
                id="MG-2024",
            )


def _message(part: _Part, name: TypeName, first: int) -> Message:
    fields, constants = [], []
    for entry in part.entries:
        comment = _documentation(entry.comment)
        element = entry.declaration.element
        if isinstance(element, Field):
            fields.append(replace(element, comment=comment))
        else:
            constants.append(replace(element, comment=comment))
    return Message(
        name, tuple(fields), tuple(constants), _documentation(part.comment), Span(part.source, first, 1)
    )


def _documentation(lines: Sequence[str]) -> tuple[str, ...]:
    """Return the lines without common indent, empty ones at both ends and two empty ones in a row."""
    kept: list[str] = []
    for line in lines:
        if line or (kept and kept[-1]):
            kept.append(line)
    if kept and not kept[-1]:
        kept.pop()
    return tuple(textwrap.dedent("\n".join(kept)).split("\n")) if kept else ()
