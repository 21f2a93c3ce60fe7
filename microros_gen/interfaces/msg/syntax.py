# SPDX-License-Identifier: Apache-2.0
"""The syntax of one declaration in a .msg file, and the reader of the plainest ones.

`msg.lark` is the grammar. Almost every line of real packages is `type name`, `type name default` or
`type NAME=value`. Building lark's tables takes longer than reading all of them, so one expression reads these, to the
tree that the grammar gives.
"""

from __future__ import annotations

import re
from typing import Any, Protocol

from microros_gen.records import dataclass

_PLAIN = re.compile(
    r"(?:(?P<primitive>bool|byte|char|float32|float64|u?int(?:8|16|32|64))"
    r"|(?P<string>w?string)(?:<=(?P<bound>[0-9]+))?"
    r"|(?P<type>[A-Za-z][A-Za-z0-9_]*)(?:/(?P<of_package>[A-Za-z][A-Za-z0-9_]*))?)"
    r"(?P<extent>\[(?:(?P<at_most><=)?(?P<size>[0-9]+))?\])?"
    r" +(?P<name>[A-Za-z][A-Za-z0-9_]*)"
    r"(?: *= *(?P<value>[!-~].*)| +(?P<default>[!-<>-~].*))?"
)


class SyntaxNode(Protocol):
    """A node of a syntax tree, as lark 1.x, lark-parser 0.12 and this module type it."""

    @property
    def data(self) -> str:
        """The name of the rule or its alias."""

    @property
    def children(self) -> Any:
        """Nodes and words, in order."""


class Word(str):
    """A word of a line, and its column (1 is the first)."""

    __slots__ = ("column",)
    column: int

    def __new__(cls, text: str, column: int) -> Word:
        """Return `text` as it is in `column` of its line."""
        word = super().__new__(cls, text)
        word.column = column
        return word


@dataclass(frozen=True)
class Node:
    """A node of the syntax tree: the name of the rule or its alias, and what it consists of (nodes and words)."""

    data: str
    children: tuple[Any, ...]


def plain_declaration(text: str) -> Node | None:
    """Return the tree of a declaration without anything unusual; None: ask the grammar."""
    found = _PLAIN.fullmatch(text)
    if found is None or (found["default"] and found["extent"]):
        return None

    def word(name: str) -> Word:
        return Word(found[name], found.start(name) + 1)

    if found["primitive"]:
        element = Node("primitive", (word("primitive"),))
    elif found["string"]:
        element = Node("string", (word("string"), word("bound")) if found["bound"] else (word("string"),))
    else:
        element = Node(
            "named", (word("type"), word("of_package")) if found["of_package"] else (word("type"),)
        )
    if found["extent"]:
        how = "unbounded" if not found["size"] else "bounded" if found["at_most"] else "fixed"
        element = Node("array", (element, Node(how, (word("size"),) if found["size"] else ())))
    if found["value"]:
        return Node("constant", (element, word("name"), word("value")))
    return Node("field", (element, word("name"), *((word("default"),) if found["default"] else ())))
