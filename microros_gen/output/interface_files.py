# SPDX-License-Identifier: Apache-2.0
"""Interfaces as files of other tools: OMG IDL, and the .json of ROS 2's type descriptions."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.interfaces.derived import declaring_name
from microros_gen.interfaces.interface_set import InterfaceSet
from microros_gen.interfaces.omg_idl.text import idl_text, included_types, names_to_escape
from microros_gen.interfaces.types import TypeName
from microros_gen.output.tree import write_files


def one_idl(interfaces: InterfaceSet, portable: bool, diagnostics: Diagnostics) -> str:
    """Return the .idl file of the one type that was asked for; of a derived type that of its service or action."""
    roots = {declaring_name(root) for root in interfaces.roots}
    if len(roots) != 1:
        message = f"found {len(roots)} interfaces, but an .idl file holds one"
        raise UserError(
            [Diagnostic(message, hint="Name one of them, or write all of them with -o DIR", id="MG-8003")]
        )
    (root,) = roots
    _warn_of_keywords(interfaces, (root,), portable, diagnostics)
    return idl_text(interfaces.interfaces[root].declaration, portable)


def write_idl(
    interfaces: InterfaceSet, folder: Path, portable: bool, diagnostics: Diagnostics
) -> tuple[int, int]:
    """Write the requested .idl files and all that they include; return how many there are, and how many changed."""
    names = _with_included(interfaces)
    _warn_of_keywords(interfaces, names, portable, diagnostics)
    files = {
        f"{name}.idl": idl_text(interfaces.interfaces[name].declaration, portable).encode() for name in names
    }
    return len(files), len(write_files(folder, files))


def write_descriptions(interfaces: InterfaceSet, folder: Path) -> tuple[int, int]:
    """Write the .json file of each type that was asked for; return how many, and how many changed."""
    files = {
        f"{name}.json": json.dumps(interfaces.hashed_description(name), indent=2).encode()
        for name in interfaces.roots
    }
    return len(files), len(write_files(folder, files))


def _with_included(interfaces: InterfaceSet) -> list[TypeName]:
    found: set[TypeName] = set()
    pending = [declaring_name(root) for root in interfaces.roots]
    while pending:
        name = pending.pop()
        if name not in found:
            found.add(name)
            pending += (declaring_name(n) for n in included_types(interfaces.interfaces[name].declaration))
    return sorted(found)


def _warn_of_keywords(
    interfaces: InterfaceSet, names: Iterable[TypeName], portable: bool, diagnostics: Diagnostics
) -> None:
    for name in () if portable else names:
        members = names_to_escape(interfaces.interfaces[name].declaration)
        if members:
            several = len(members) > 1
            diagnostics.warning(
                f"{name}: {', '.join(members)} {'are keywords' if several else 'is a keyword'} of IDL;"
                " ROS 2 takes them as names, other IDL compilers do not",
                hint=f"For those add --portable: then '_{members[0]}' is written",
                id="MG-8004",
            )
