# SPDX-License-Identifier: Apache-2.0
"""What somebody meant who wrote a type that .msg files do not have."""

from __future__ import annotations

import re
from collections.abc import Iterable

from microros_gen.diagnostics import nearest

_OTHER_LANGUAGES = {
    **{
        "boolean": "bool",
        "octet": "byte",
        "short": "int16",
        "int": "int32",
        "long": "int64",
        "unsigned": "uint32",
    },
    **{"float": "float32", "double": "float64", "str": "string", "wchar": "wstring"},
}
_UNSIGNED = re.compile(r"unsigned +(char|short|int|long long|long)(?: +int)?(?= )")
_UNSIGNED_TYPES = {
    "char": "uint8",
    "short": "uint16",
    "int": "uint32",
    "long": "uint64",
    "long long": "uint64",
}
_NO_TYPES = {
    "enum": "Write a constant for each value: 'uint8 FIRST=0'",
    "struct": "Write its fields into a separate .msg file",
    "@optional": "Remove it: fields of a .msg are always there; a sequence 'type[<=1]' can be empty",
}
"""What begins a declaration in C or IDL → what to do instead."""
_SCOPED = re.compile(r"([a-z][a-z0-9_]*)(?:::|[.])(?:msg(?:::|[.]))?([A-Z][A-Za-z0-9]*)")
"""A type as C++ and Python write it."""


def is_unsigned_of_c(declaration: str) -> bool:
    """Return whether a declaration begins with a type of C of several words, such as `unsigned char`."""
    return _UNSIGNED.match(declaration) is not None


def type_hint(name: str, declaration: str, primitives: Iterable[str]) -> str | None:
    """Return what to write instead of the type `name` of a declaration; None if nothing is like it."""
    unsigned = _UNSIGNED.match(declaration) if name == "unsigned" else None
    if unsigned is not None:
        return f"Write '{_UNSIGNED_TYPES[unsigned[1]]}{declaration[unsigned.end() :]}'"
    if name in _OTHER_LANGUAGES:
        return f"Write '{_OTHER_LANGUAGES[name]}'"
    if name in _NO_TYPES:
        return _NO_TYPES[name]
    known = [*primitives, "string", "wstring"]
    words = declaration.split()
    if len(words) == 2 and words[1] in known:
        return f"Write '{words[1]} {name}'"
    scoped = _SCOPED.fullmatch(name)
    return f"Write '{scoped[1]}/{scoped[2]}'" if scoped is not None else nearest(name, known)
