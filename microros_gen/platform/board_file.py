# SPDX-License-Identifier: Apache-2.0
"""board.yaml of a board part: keys of a target file that hold for the board, whatever else the target consists of."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.documents.files import is_file, read_text, reason_of
from microros_gen.documents.tree_values import text_of
from microros_gen.documents.yaml_tree import MappingNode, parse_yaml
from microros_gen.platform.part_file import PartFolder, find_part
from microros_gen.platform.target_file import SCHEMA, merge_target
from microros_gen.records import dataclass
from microros_gen.selection.extension import Extensions
from microros_gen.selection.find_components import BOARD_FILE

BOARD_KEYS = (
    "clock_hz",
    "cpu_hz",
    "cycles_per_instruction",
    "flash",
    "ram",
    "memories",
    "uart",
    "unique_id",
    "interrupts",
    "registers",
    "hooks",
    "stdio",
    "emulator",
)
"""Keys of a target file that belong to the board; compiler, flags and other parts do not."""
_EXTENDS = {
    "description": "A board by name, or its folder relative to this one, whose facts hold unless this file has them.",
    "type": "string",
    "minLength": 1,
    "x-expects": "the name of a board, or a folder as ../my_board",
}


@dataclass(frozen=True)
class BoardFacts:
    """What the board.yaml of a board and of those that it extends say.

    `own` are those files of the user's that belong to no part of the target, in the order of `extends`.
    """

    node: MappingNode
    own: tuple[Source, ...] = ()


def board_facts(
    name: str, near: Path, span: Span | None, diagnostics: Diagnostics, extensions: Extensions
) -> BoardFacts | None:
    """Return what the board.yaml of the board part `name` says; None: the part has none, or cannot be read.

    Errors in it go to `diagnostics`. A part that does not exist is reported where the target's parts are read.
    """
    place = find_part("board", name, near, span, Diagnostics(), extensions)
    if place is None or not is_file(place.path / BOARD_FILE):
        return None
    return _read(place, span, diagnostics, extensions, ())


def board_schema(schema: dict[str, Any]) -> dict[str, Any]:
    """Return the JSON Schema of a board.yaml, from that of target files."""
    properties = {key: schema["properties"][key] for key in BOARD_KEYS}
    return {**schema, "properties": {"extends": _EXTENDS, **properties}, "required": []}


def _read(
    place: PartFolder,
    span: Span | None,
    diagnostics: Diagnostics,
    extensions: Extensions,
    visited: tuple[Path, ...],
) -> BoardFacts | None:
    path = place.path / BOARD_FILE
    try:
        source = Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        diagnostics.error(f"cannot read '{path}': {reason_of(error)}", span, id="MG-6031")
        return None
    node = _parse(source, place.own, diagnostics)
    if node is None:
        return None
    facts = BoardFacts(node, (source,) if place.own and (visited or not place.is_component) else ())
    base = node.get("extends")
    if base is None:
        return facts
    name, known = text_of(base) or "", (*visited, place.path.resolve())
    below = find_part("board", name, place.path, base.span, diagnostics, extensions)
    if below is None:
        return None
    if below.path.resolve() in known:
        hint = "Remove `extends:` from one of them"
        diagnostics.error(f"the board '{name}' extends itself", base.span, hint, id="MG-6032")
        return None
    further = _read(below, base.span, diagnostics, extensions, known)
    if further is None:
        return None
    return BoardFacts(_without_extends(merge_target(node, further.node)), (*facts.own, *further.own))


def _parse(source: Source, own: bool, diagnostics: Diagnostics) -> MappingNode | None:
    """Return what one file says. A user's file is validated; tests validate those that ship with the tool."""
    found = Diagnostics()
    tree = parse_yaml(source, found)
    if not found.has_errors() and (own or not isinstance(tree, MappingNode)):
        from microros_gen.documents.schema import load_schema, validate

        validate(tree, source, board_schema(load_schema(SCHEMA)), found)
    diagnostics.extend(found)
    return tree if isinstance(tree, MappingNode) and not found.has_errors() else None


def _without_extends(node: MappingNode) -> MappingNode:
    return MappingNode({key: entry for key, entry in node.entries.items() if key != "extends"}, node.span)
