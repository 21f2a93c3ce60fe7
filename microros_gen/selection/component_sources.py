# SPDX-License-Identifier: Apache-2.0
"""Reads the C files of components."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.templates import TEMPLATE_FOLDERS
from microros_gen.records import dataclass
from microros_gen.selection.component import Component
from microros_gen.selection.contribution import Conditions

Holds = Callable[[Conditions], bool]
"""Whether a plan meets conditions."""


@dataclass(frozen=True)
class ComponentFile:
    """One file of a component: where it goes, its bytes, and where it was read.

    `template` is the template's name where it is one; empty for a template that does not ship with the tool.
    """

    path: str
    content: bytes
    template: str | None
    source: Path


def component_files(
    components: Iterable[Component], holds: Holds, provided: Iterable[tuple[str, str]] = ()
) -> tuple[ComponentFile, ...]:
    """Return the files of the selected `components` in a plan of which `holds` tells.

    `provided` are sources, each with its component, that a platform provides besides.

    Raises UserError where two components stand in for the same header of a third one.
    """
    chosen = tuple(components)
    replaced = _replaced(chosen, holds)
    files: list[ComponentFile] = []
    besides = tuple(provided)
    for component in chosen:
        files += _headers(component, replaced)
        files += _variants(component, replaced, holds)
        own = [source.path for source in component.sources if holds(source.when)]
        files += _sources(component, (*own, *(path for name, path in besides if name == component.name)))
    return tuple(files)


def _replaced(components: Iterable[Component], holds: Holds) -> dict[str, str]:
    """Return which component stands in for the one that brings a header."""
    diagnostics = Diagnostics()
    found: dict[str, str] = {}
    for component in components:
        for replacement in component.contributes.replaces:
            header = replacement.header
            if not holds(replacement.when):
                continue
            if header in found:
                message = f"the components '{found[header]}' and '{component.name}' both replace '{header}'"
                diagnostics.error(message, None, "Select one of them", id="MG-4043")
            found[header] = component.name
    diagnostics.check()
    return found


def _headers(component: Component, replaced: Mapping[str, str]) -> Iterator[ComponentFile]:
    """Yield what is below include/; a header that stands in for another only where it does."""
    folder = component.folder / "include"
    stands_in = {r.header for r in component.contributes.replaces}
    for path in sorted(p for p in folder.rglob("*") if p.is_file()) if folder.is_dir() else []:
        header = path.relative_to(folder).as_posix()
        owner = replaced.get(header.removesuffix(".j2"))
        if owner == component.name or (owner is None and header.removesuffix(".j2") not in stands_in):
            yield _file(path, f"include/{header}")


def _variants(component: Component, replaced: Mapping[str, str], holds: Holds) -> Iterator[ComponentFile]:
    folder = component.folder / "variants"
    for variant in component.contributes.variants:
        if holds(variant.when) and replaced.get(variant.header, component.name) == component.name:
            yield _file(folder / variant.file, f"include/{variant.header}")


def _sources(component: Component, names: Iterable[str]) -> Iterator[ComponentFile]:
    folder = component.folder / "src"
    for name in names:
        yield _file(folder / name, f"src/{component.name}/{name}")


def _file(path: Path, target: str) -> ComponentFile:
    template = template_name(path) if path.suffix == ".j2" else None
    return ComponentFile(target.removesuffix(".j2"), path.read_bytes(), template, path)


def template_names(components: Iterable[Component]) -> Iterator[str]:
    """Yield the templates in the folders of those `components` that ship with the tool."""
    for component in components:
        yield from filter(None, map(template_name, sorted(component.folder.rglob("*.j2"))))


def template_name(path: Path) -> str:
    """Return the name of a template that ships with the tool; empty for one that does not."""
    own = (path.relative_to(f).as_posix() for f in TEMPLATE_FOLDERS if path.is_relative_to(f))
    return next(own, "")
