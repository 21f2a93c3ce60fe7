# SPDX-License-Identifier: Apache-2.0
"""The keywords of OMG IDL 4.2 (7.2.4, table 7-6)."""

from __future__ import annotations

# fmt: off
_KEYWORDS = frozenset((
    "abstract", "any", "alias", "attribute", "bitfield", "bitmask", "bitset", "boolean", "case", "char",
    "component", "connector", "const", "consumes", "context", "custom", "default", "double", "emits",
    "enum", "eventtype", "exception", "factory", "false", "finder", "fixed", "float", "getraises", "home",
    "import", "in", "inout", "int8", "int16", "int32", "int64", "interface", "local", "long", "manages",
    "map", "mirrorport", "module", "multiple", "native", "object", "octet", "oneway", "out", "port",
    "porttype", "primarykey", "private", "provides", "public", "publishes", "raises", "readonly",
    "sequence", "setraises", "short", "string", "struct", "supports", "switch", "true", "truncatable",
    "typedef", "typeid", "typename", "typeprefix", "uint8", "uint16", "uint32", "uint64", "union",
    "unsigned", "uses", "valuebase", "valuetype", "void", "wchar", "wstring",
))
# fmt: on


def is_keyword(name: str) -> bool:
    """Return whether `name` is a keyword, in whatever case: what differs from one in case alone collides with it."""
    return name.lower() in _KEYWORDS
