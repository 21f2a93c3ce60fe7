# SPDX-License-Identifier: Apache-2.0
"""Reads the C files of components and the target files that ship with the tool."""

from __future__ import annotations

from pathlib import Path

import microros_gen
from microros_gen.records import dataclass
from microros_gen.selection.find_components import components_folder

PACKAGE = Path(microros_gen.__file__).resolve().parent
COMPONENTS = components_folder()


@dataclass(frozen=True)
class ComponentFile:
    """One file of a component: where it goes, its bytes, and the template's name where it is one."""

    path: str
    content: bytes
    template: str | None


def read_headers(component: str) -> tuple[ComponentFile, ...]:
    """Return everything below the component's include/, placed below `include/` of the output."""
    folder = COMPONENTS / component / "include"
    paths = sorted(p for p in folder.rglob("*") if p.is_file()) if folder.is_dir() else []
    return tuple(_file(component, p, f"include/{p.relative_to(folder).as_posix()}") for p in paths)


def read_sources(component: str, names: tuple[str, ...]) -> tuple[ComponentFile, ...]:
    """Return the named files of the component's src/, placed in `src/<component>/` of the output."""
    folder = COMPONENTS / component / "src"
    return tuple(_file(component, folder / name, f"src/{component}/{name}") for name in names)


def _file(component: str, path: Path, target: str) -> ComponentFile:
    is_template = path.suffix == ".j2"
    name = path.relative_to(COMPONENTS).as_posix() if is_template else None
    return ComponentFile(target.removesuffix(".j2"), path.read_bytes(), name)
