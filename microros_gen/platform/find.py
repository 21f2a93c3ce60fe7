# SPDX-License-Identifier: Apache-2.0
"""Finds and reads target files: the built-in ones, those of folders and packages, and a user's own by its path."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source, Span, nearest
from microros_gen.documents.files import read_text, reason_of
from microros_gen.documents.named import Named
from microros_gen.documents.shipped import TARGETS
from microros_gen.documents.tree_values import text_of
from microros_gen.documents.yaml_tree import MappingNode
from microros_gen.platform.board_file import board_facts
from microros_gen.platform.chosen_parts import NO_PARTS, with_parts
from microros_gen.platform.target import Target
from microros_gen.platform.target_file import merge_target, parse_target, target_of
from microros_gen.records import dataclass
from microros_gen.selection.extension import INSTALLED, Extensions

__all__ = ["TARGETS", "FoundTarget", "builtin_targets", "read_target", "target_names"]


@dataclass(frozen=True)
class FoundTarget:
    """A target, and the files of the user's that it came from, the one that was asked for first.

    `boards` are those of them that are a board.yaml without a component. `origin` says who brings the target where
    that is a folder or a package: `pip package robot`.
    """

    target: Target
    own: tuple[Source, ...] = ()
    boards: tuple[Source, ...] = ()
    origin: str = ""


def builtin_targets() -> tuple[str, ...]:
    """Return the names of the built-in targets, sorted."""
    return tuple(sorted(path.stem for path in TARGETS.glob("[a-z]*.yaml")))


def target_names(extensions: Extensions = INSTALLED) -> tuple[str, ...]:
    """Return the names of all targets that installed packages bring or that are built in; these come first."""
    of_extensions = {name for extension in extensions.installed() for name in extension.target_names()}
    return (*builtin_targets(), *sorted(of_extensions - set(builtin_targets())))


def read_target(
    name: str,
    near: Path,
    span: Span | None,
    diagnostics: Diagnostics,
    extensions: Extensions = INSTALLED,
    parts: Mapping[str, Named | None] = NO_PARTS,
) -> FoundTarget | None:
    """Read a target by its name, or a file by its path (relative to `near`) with all that it extends.

    A name, and parts that it names, that are not built in come from `extensions`. `parts` replace those of the target,
    by their kind. None and errors in `diagnostics` if it does not exist or one of its files is invalid.
    """
    found = Diagnostics()
    reader = _Reader(found, extensions)
    node = reader.read(name, near, span)
    if node is not None:
        node = with_parts(node, parts, found)
    target = target_of(node, found, extensions) if node is not None else None
    diagnostics.extend(found)
    return (
        FoundTarget(target, tuple(reader.own), tuple(reader.boards), reader.origin)
        if target is not None
        else None
    )


class _Reader:
    """Follows `extends` from file to file."""

    def __init__(self, diagnostics: Diagnostics, extensions: Extensions) -> None:
        self.own: list[Source] = []
        self.boards: list[Source] = []
        self.origin = ""
        self._diagnostics = diagnostics
        self._extensions = extensions
        self._way: list[Path] = []

    def read(self, name: str, near: Path, span: Span | None) -> MappingNode | None:
        """Return what a target says, and below it what it extends."""
        known = builtin_targets()
        builtin = name in known or (near == TARGETS and (TARGETS / f"{name}.yaml").is_file())
        found = None
        if not builtin and not name.endswith((".yaml", ".yml")):
            found = self._brought(name, span)
            if found is None:
                return None
        path = found or (TARGETS / f"{name}.yaml" if builtin else near / name)
        if path.resolve() in self._way:
            self._diagnostics.error(
                f"'{name}' extends itself",
                span,
                "Let the last one extend a built-in target or none",
                id="MG-6002",
            )
            return None
        self._way.append(path.resolve())
        source = self._source(path, name, span)
        node = parse_target(source, self._diagnostics, builtin) if source is not None else None
        if source is None or node is None:
            return None
        if not builtin:
            self.own.append(source)
        return self._extended(self._with_board(node), path.parent)

    def _brought(self, name: str, span: Span | None) -> Path | None:
        """Return the file of a target that a folder or a package brings; None and an error where none does."""
        faults = len(tuple(self._diagnostics))
        extension = self._extensions.target(name, span, self._diagnostics)
        if extension is None and len(tuple(self._diagnostics)) == faults:
            known = target_names(self._extensions)
            hint = nearest(name, known) or f"Available: {', '.join(known)}; or give the path of a target file"
            self._diagnostics.error(f"unknown target '{name}'", span, hint, id="MG-6001")
        if extension is None:
            return None
        self.origin = self.origin or extension.origin
        return extension.target(name)

    def _with_board(self, node: MappingNode) -> MappingNode:
        """Lay a target file over the facts of the board that it names: both override what it extends."""
        board = node.get("board")
        if board is None:
            return node
        folder = Path(board.span.source.name).parent
        facts = board_facts(text_of(board) or "", folder, board.span, self._diagnostics, self._extensions)
        if facts is None:
            return node
        self.boards += facts.own
        return merge_target(node, facts.node)

    def _extended(self, node: MappingNode, near: Path) -> MappingNode | None:
        below = node.get("extends")
        if below is None:
            return node
        base = self.read(text_of(below) or "", near, below.span)
        return merge_target(node, base) if base is not None else None

    def _source(self, path: Path, shown: str, span: Span | None) -> Source | None:
        try:
            return Source(str(path), read_text(path))
        except (OSError, UnicodeDecodeError) as error:
            hint = f"Available: {', '.join(builtin_targets())}; a path is relative to the file that names it"
            self._diagnostics.error(
                f"cannot read the target file '{shown}': {reason_of(error)}", span, hint, id="MG-6003"
            )
            return None
