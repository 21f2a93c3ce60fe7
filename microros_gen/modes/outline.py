# SPDX-License-Identifier: Apache-2.0
"""The parts of a model file before their modes are read: what they are called, and which modes they have."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping

from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.tree_read import check_keys, expect_mapping, read_choice
from microros_gen.documents.tree_values import child
from microros_gen.documents.yaml_tree import Entry, MappingNode
from microros_gen.modes.model import DEFAULT
from microros_gen.modes.statuses import Subject
from microros_gen.records import dataclass

PARAMETERS = "ros__parameters"
_NODE_KEYS = ("type", "modes")
_SYSTEM_KEYS = (*_NODE_KEYS, "parts", "rules", "start_after")
_OPTIONAL_NODE_KEYS = ("contingencies", "diagnostics")
_NAME = re.compile(r"[A-Za-z_]\w*(/[A-Za-z_]\w*)*", re.ASCII)
_MODE = re.compile(r"[A-Za-z_]\w*", re.ASCII)


@dataclass(frozen=True)
class Outline:
    """A part: `body` is the mapping below `ros__parameters`, `modes` has the entries of its modes."""

    name: str
    is_system: bool
    span: Span
    body: MappingNode
    modes: Mapping[str, Entry]

    @property
    def subject(self) -> Subject:
        """Return the part as one whose status is read."""
        return Subject(self.name, self.is_system, tuple(self.modes))


def plain_name(name: str) -> str:
    """Return the name of a part without the slash that a fully qualified name begins with."""
    return name.removeprefix("/")


def parse_outlines(
    tree: MappingNode, diagnostics: Diagnostics, with_leaflets: Collection[str] = ()
) -> tuple[dict[str, Outline], frozenset[str]]:
    """Return the parts by name, in the order of the file, and the names of those that cannot be read.

    Nodes in `with_leaflets` have modes elsewhere, and need not have them here.
    """
    found: dict[str, Outline] = {}
    unreadable: set[str] = set()
    for name, entry in _parts(tree, ""):
        outline = _outline(name, entry, diagnostics, name in with_leaflets)
        if outline is None:
            unreadable.add(name)
            continue
        if name in found:
            message = f"duplicate part '{name}'; first in line {found[name].span.line}"
            diagnostics.error(message, entry.key_span, "Remove one of them", id="MG-8804")
            continue
        found[name] = outline
    return found, frozenset(unreadable - found.keys())


def _parts(tree: MappingNode, namespace: str) -> Iterator[tuple[str, Entry]]:
    """Yield each part with its name; namespaces can be levels around parts, as in files of ROS 2 parameters."""
    for entry in tree:
        name = f"{namespace}{plain_name(entry.key)}"
        if _is_namespace(entry) and isinstance(entry.value, MappingNode):
            yield from _parts(entry.value, f"{name}/")
        else:
            yield name, entry


def _is_namespace(entry: Entry) -> bool:
    node = entry.value
    if not isinstance(node, MappingNode) or any(key in node.entries for key in (PARAMETERS, *_SYSTEM_KEYS)):
        return False
    below = [inner.value for inner in node if isinstance(inner.value, MappingNode)]
    return bool(below) and not any("type" in inner.entries for inner in below)


def _outline(name: str, entry: Entry, diagnostics: Diagnostics, has_leaflet: bool) -> Outline | None:
    if not _NAME.fullmatch(name):
        message = f"'{name}' is not the name of a part"
        diagnostics.error(message, entry.key_span, "Use letters, digits, '_' and '/'", id="MG-8805")
        return None
    body = child(entry.value, PARAMETERS)
    if body is None:
        _report_missing(name, entry, diagnostics)
        return None
    body = expect_mapping(body, f"'{PARAMETERS}' of '{name}'", diagnostics)
    if body is None or not isinstance(entry.value, MappingNode):
        return None
    check_keys(entry.value, (PARAMETERS,), (), diagnostics)
    kind = read_choice(body, "type", ("system", "node"), diagnostics)
    if kind is None and body.get("type") is not None:
        return None
    is_system = kind is not None and kind.name == "system"
    required = (*_NODE_KEYS, "parts") if is_system else ("type",) if has_leaflet else _NODE_KEYS
    known = _SYSTEM_KEYS if is_system else (*_NODE_KEYS, *_OPTIONAL_NODE_KEYS)
    check_keys(body, known, required, diagnostics)
    if kind is None:
        return None
    return Outline(name, is_system, entry.key_span, body, _modes(name, body, diagnostics))


def _report_missing(name: str, entry: Entry, diagnostics: Diagnostics) -> None:
    """Report a part without `ros__parameters`, at the key that may be it."""
    below = tuple(entry.value) if isinstance(entry.value, MappingNode) else ()
    span, hint = entry.key_span, f"Indent its keys below `{PARAMETERS}:`"
    for inner in below if len(below) == 1 else ():
        meant = nearest(inner.key, (PARAMETERS,))
        span, hint = (inner.key_span, meant) if meant else (span, hint)
    diagnostics.error(f"the part '{name}' has no '{PARAMETERS}'", span, hint, id="MG-8803")


def _modes(part: str, body: MappingNode, diagnostics: Diagnostics) -> dict[str, Entry]:
    modes = expect_mapping(body.get("modes"), f"'modes' of '{part}'", diagnostics)
    found: dict[str, Entry] = {}
    for entry in modes or ():
        found[entry.key] = entry
        if not _MODE.fullmatch(entry.key):
            message = f"'{entry.key}' is not the name of a mode"
            diagnostics.error(message, entry.key_span, "Use letters, digits and '_'", id="MG-8811")
    if modes is not None and DEFAULT not in modes.entries:
        message = f"the part '{part}' has no mode {DEFAULT}"
        span, hint = body.entries["modes"].key_span, f"Add `{DEFAULT}:` before its other modes"
        for entry in modes:
            if entry.key.strip("_").upper() == DEFAULT.strip("_"):
                span, hint = entry.key_span, f"Write {DEFAULT}"
        diagnostics.error(message, span, hint, id="MG-8810")
    return found
