# SPDX-License-Identifier: Apache-2.0
"""The capabilities of a platform: groups of C functions that parts provide and components ask for."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.files import read_text
from microros_gen.documents.templates import TEMPLATE_FOLDERS
from microros_gen.documents.tree_values import bool_of, entries, items, text_of
from microros_gen.documents.yaml_tree import parse_yaml
from microros_gen.records import dataclass

CAPABILITIES_FILE = Path(__file__).with_name("capabilities.yaml")


@dataclass(frozen=True)
class Capability:
    """A group of C functions that `header` declares.

    `of_application`: the application has it on every platform, and the generated example does without it.
    """

    name: str
    summary: str
    header: str
    functions: tuple[str, ...]
    of_application: bool = False


@cache
def capabilities() -> Mapping[str, Capability]:
    """Return all capabilities by name, in the order in which they are shown."""
    diagnostics = Diagnostics()
    tree = parse_yaml(Source(CAPABILITIES_FILE.name, read_text(CAPABILITIES_FILE)), diagnostics)
    diagnostics.check()
    found = {}
    for entry in entries(tree):
        facts = {fact.key: fact.value for fact in entries(entry.value)}
        found[entry.key] = Capability(
            entry.key,
            text_of(facts["summary"]) or "",
            text_of(facts["header"]) or "",
            tuple(text_of(item) or "" for item in items(facts["functions"])),
            bool_of(facts.get("application")) or False,
        )
    return MappingProxyType(found)


@cache
def declarations(capability: Capability) -> tuple[str, ...]:
    """Return the prototypes of a capability's functions, as its header has them.

    A component is one folder below those of the templates, a part of a platform two: not all folders are searched.
    """
    places = (f"{below}/include/{capability.header}" for below in ("*", "*/*"))
    headers = (path for place in places for folder in TEMPLATE_FOLDERS for path in folder.glob(place))
    return prototypes(read_text(next(headers)), capability.functions)


def prototypes(header: str, functions: tuple[str, ...]) -> tuple[str, ...]:
    """Return how `header` (its text) declares each of the functions, on one line each."""
    found = {}
    for match in re.finditer(r"^[a-z][^;{}()#]*\b(\w+)\([^;{}]*?\);", header, re.MULTILINE):
        found[match.group(1)] = " ".join(match.group(0).split()).replace("( ", "(")
    return tuple(found[name] for name in functions)
