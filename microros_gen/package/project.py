# SPDX-License-Identifier: Apache-2.0
"""`project` of package.yaml: what a new project with the package consists of."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import PurePosixPath

from microros_gen.documents.tree_values import bool_of, child_text, entries, items, text_of
from microros_gen.documents.yaml_tree import MappingNode
from microros_gen.records import dataclass

_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)


@dataclass(frozen=True)
class Need:
    """Functions one of which the sources of a project must name, and what to write if they do not."""

    functions: tuple[str, ...]
    hint: str

    def is_met(self, texts: Iterable[str]) -> bool:
        """Return whether one of the texts, in C, names such a function before a parenthesis."""
        names = "|".join(re.escape(name) for name in self.functions)
        pattern = re.compile(rf"\b(?:{names})\s*\(")
        return any(pattern.search(_COMMENT.sub(" ", text)) for text in texts)


@dataclass(frozen=True)
class Project:
    """Where a project has the package and the sources; paths below its folder, `{name}` is the name of the project.

    The main file of the sources whose suffix is a key of `renamed` gets the name there. `example` is the program of a
    project that is made of nothing, below the package's folder or that of its `files_of`. `entry` are the functions
    with which a program begins, `transports` what it calls first, by its transport. `next` are the commands that build,
    `{dir}` is the project. `keyed`: boards may have no number, so a project has a client key.
    """

    library: str
    sources: str
    renamed: tuple[tuple[str, str], ...]
    example: str
    entry: Need
    transports: tuple[tuple[str, Need], ...]
    next: tuple[str, ...]
    keyed: bool = False

    def place_of_library(self, name: str) -> str:
        """Return the folder of the package in the project `name`."""
        return self.library.replace("{name}", name)

    def place_of_source(self, path: str, name: str, is_main: bool) -> str:
        """Return where the project `name` has a source; `is_main`: the program begins in it."""
        place = PurePosixPath(path)
        for suffix, renamed in self.renamed:
            if is_main and place.suffix == suffix:
                place = place.with_name(renamed.replace("{name}", name))
        return f"{self.sources.replace('{name}', name)}{place}"

    def needs_of(self, transport: str) -> tuple[Need, ...]:
        """Return what the sources of a program with this transport must have."""
        return (self.entry, *(need for kind, need in self.transports if kind == transport))


def parse_project(node: object) -> Project | None:
    """Return the project of a package.yaml that holds to the schema; None without one."""
    if not isinstance(node, MappingNode):
        return None
    return Project(
        library=child_text(node, "library"),
        sources=child_text(node, "sources"),
        renamed=tuple((entry.key, text_of(entry.value) or "") for entry in entries(node.get("renamed"))),
        example=child_text(node, "example"),
        entry=_need(node.get("entry")),
        transports=tuple((entry.key, _need(entry.value)) for entry in entries(node.get("transports"))),
        next=tuple(text_of(item) or "" for item in items(node.get("next"))),
        keyed=bool_of(node.get("client_key")) is True,
    )


def _need(node: object) -> Need:
    assert isinstance(node, MappingNode)
    return Need(tuple(text_of(item) or "" for item in items(node.get("functions"))), child_text(node, "hint"))
