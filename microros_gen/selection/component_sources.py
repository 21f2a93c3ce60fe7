# SPDX-License-Identifier: Apache-2.0
"""Reads the C files of components."""

from __future__ import annotations

from pathlib import Path

from microros_gen.documents.templates import TEMPLATE_FOLDERS
from microros_gen.records import dataclass
from microros_gen.selection.component import Component


@dataclass(frozen=True)
class ComponentFile:
    """One file of a component: where it goes, its bytes, and where it was read.

    `template` is the template's name where it is one; empty for a template that does not ship with the tool.
    """

    path: str
    content: bytes
    template: str | None
    source: Path


def read_headers(component: Component) -> tuple[ComponentFile, ...]:
    """Return everything below the component's include/, placed below `include/` of the output."""
    folder = component.folder / "include"
    paths = sorted(p for p in folder.rglob("*") if p.is_file()) if folder.is_dir() else []
    return tuple(_file(p, f"include/{p.relative_to(folder).as_posix()}") for p in paths)


def read_sources(component: Component, names: tuple[str, ...]) -> tuple[ComponentFile, ...]:
    """Return the named files of the component's src/, placed in `src/<component>/` of the output."""
    folder = component.folder / "src"
    return tuple(_file(folder / name, f"src/{component.name}/{name}") for name in names)


def _file(path: Path, target: str) -> ComponentFile:
    template = _template_name(path) if path.suffix == ".j2" else None
    return ComponentFile(target.removesuffix(".j2"), path.read_bytes(), template, path)


def _template_name(path: Path) -> str:
    own = (path.relative_to(f).as_posix() for f in TEMPLATE_FOLDERS if path.is_relative_to(f))
    return next(own, "")
