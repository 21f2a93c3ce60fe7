# SPDX-License-Identifier: Apache-2.0
"""Finds and reads target files: the built-in ones, and a user's own by its path."""

from __future__ import annotations

from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source, Span, nearest
from microros_gen.model.target import Target
from microros_gen.parse.target import parse_target
from microros_gen.sources.runtime import TARGETS


def builtin_targets() -> tuple[str, ...]:
    """Return the names of the built-in targets, sorted."""
    return tuple(sorted(path.stem for path in TARGETS.glob("*.yaml")))


def read_target(name: str, near: Path, span: Span | None, diagnostics: Diagnostics) -> Target | None:
    """Read a target by its name, or a file by its path (relative to `near`); errors go to `diagnostics`."""
    known = builtin_targets()
    if name in known:
        return _read(TARGETS / f"{name}.yaml", name, span, diagnostics)
    if name.endswith((".yaml", ".yml")):
        return _read(near / name, name, span, diagnostics)
    hint = nearest(name, known) or f"There are: {', '.join(known)}; or give the path of a target file"
    diagnostics.error(f"there is no target '{name}'", span, hint)
    return None


def _read(path: Path, shown: str, span: Span | None, diagnostics: Diagnostics) -> Target | None:
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        diagnostics.error(f"cannot read the target file '{shown}': {error}", span)
        return None
    return parse_target(Source(str(path), text), diagnostics)
