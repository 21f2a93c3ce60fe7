# SPDX-License-Identifier: Apache-2.0
"""Type hashes for the agent: computed from interface files when a client first names a type."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache
from pathlib import Path

from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import InterfaceSet, resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder
from microros_gen.interfaces.types import TypeName

KEPT_SETS, KEPT_HASHES = 64, 4096
"""Declarations, and hashes, that are remembered: names come from the network."""


def type_hashes(interface_paths: Iterable[Path] = ()) -> Callable[[str], str | None]:
    """Return what gives the RIHS01 hash of `pkg/kind/Type`, also of a derived type (`pkg/srv/Type_Request`).

    Files are looked for as by all commands: `interface_paths`, the ament index, pip, the shipped set. None where no
    readable file has the type or something that it needs. UserError when a path of the user is none.
    """
    finder = InterfaceFinder.from_environment(interface_paths)
    diagnostics = Diagnostics()
    finder.check_paths(diagnostics)
    diagnostics.check()

    @lru_cache(KEPT_SETS)
    def declared(name: str) -> InterfaceSet | None:
        found = Diagnostics()
        try:
            interfaces = resolve_interfaces((Named(name),), finder, found)
        except UserError:
            return None
        return None if found.has_errors() else interfaces

    @lru_cache(KEPT_HASHES)
    def hash_of(name: str) -> str | None:
        interfaces = declared(name)
        try:
            return interfaces.type_hash(TypeName(*name.split("/"))) if interfaces else None
        except (KeyError, TypeError):
            return None

    return hash_of
