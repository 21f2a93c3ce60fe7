# SPDX-License-Identifier: Apache-2.0
"""Where components, profiles and parts of platforms come from that do not ship with the tool.

A folder that the application file names is one component (it has a `component.yaml`) or holds several things, as an
installed package does: `components/<name>/`, `profiles/<name>.yaml`, `platform/<kind>/<name>/`, `targets/<name>.yaml`.
Installed packages are looked at only for names that nothing else has, so what else is installed never changes an
output.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from microros_gen.application.model import Application, ComponentChange
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.files import is_file, is_folder, read_bytes
from microros_gen.records import dataclass
from microros_gen.selection.find_components import BOARD_FILE, COMPONENT_FILE, part_files
from microros_gen.selection.installed import installed_packages
from microros_gen.selection.presence import EXAMPLE_FILE

_FOLDERS = ("components", "profiles", "platform", "targets")
_OWN_FILES = (COMPONENT_FILE, EXAMPLE_FILE, "cpu.yaml", "os.yaml", BOARD_FILE)
_OWN_FOLDERS = ("include", "src", "variants")


@dataclass(frozen=True)
class Extension:
    """A folder that brings something; `origin` says where it is from: `folder diagnostics`, `pip package robot`.

    `span` is where the application file names it.
    """

    origin: str
    folder: Path
    span: Span | None = None

    @property
    def is_component(self) -> bool:
        """Whether the folder is one component, and not a folder of several things."""
        return is_file(self.folder / COMPONENT_FILE)

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing in it that one could look for."""
        return not self.is_component and not any(is_folder(self.folder / name) for name in _FOLDERS)

    def component(self, name: str) -> Path | None:
        """Return the folder of the component `name` where it brings that."""
        if self.is_component:
            return self.folder if own_name(self.folder) == name else None
        folder = self.folder / "components" / name
        return folder if is_file(folder / COMPONENT_FILE) else None

    def profile(self, name: str) -> Path | None:
        """Return the file of the profile `name` where it brings that."""
        path = self.folder / "profiles" / f"{name}.yaml"
        return path if is_file(path) else None

    def target(self, name: str) -> Path | None:
        """Return the file of the target `name` where it brings that."""
        path = self.folder / "targets" / f"{name}.yaml"
        return path if is_file(path) else None

    def part(self, kind: str, name: str) -> Path | None:
        """Return the folder of a part of platforms where it brings that."""
        folder = self.folder / "platform" / kind / name
        return folder if any(is_file(folder / file) for file in part_files(kind)) else None

    def component_names(self) -> tuple[str, ...]:
        """Return the names of its components, sorted."""
        if self.is_component:
            return (own_name(self.folder),)
        return tuple(sorted(p.parent.name for p in (self.folder / "components").glob(f"*/{COMPONENT_FILE}")))

    def target_names(self) -> tuple[str, ...]:
        """Return the names of its targets, sorted; a file `_x.yaml` is only extended."""
        return tuple(sorted(p.stem for p in (self.folder / "targets").glob("[a-z]*.yaml")))

    def profile_names(self) -> tuple[str, ...]:
        """Return the names of its profiles, sorted."""
        return tuple(sorted(p.stem for p in (self.folder / "profiles").glob("*.yaml")))


@dataclass(frozen=True)
class Extensions:
    """The folders that the application file names and, for what none of them has, the packages that are installed."""

    named: tuple[Extension, ...] = ()
    environ: Mapping[str, str] | None = None

    def component(self, name: str, span: Span | None, diagnostics: Diagnostics) -> Extension | None:
        """Return who brings the component `name`; two that do are an error in `diagnostics`."""
        return self._only(f"component '{name}'", span, diagnostics, lambda e: e.component(name))

    def profile(self, name: str, span: Span | None, diagnostics: Diagnostics) -> Extension | None:
        """Return who brings the profile `name`; two that do are an error in `diagnostics`."""
        return self._only(f"profile '{name}'", span, diagnostics, lambda e: e.profile(name))

    def target(self, name: str, span: Span | None, diagnostics: Diagnostics) -> Extension | None:
        """Return who brings the target `name`; two that do are an error in `diagnostics`."""
        return self._only(f"target '{name}'", span, diagnostics, lambda e: e.target(name))

    def part(self, kind: str, name: str, span: Span | None, diagnostics: Diagnostics) -> Extension | None:
        """Return who brings a part of platforms; two that do are an error in `diagnostics`."""
        return self._only(f"{kind} '{name}'", span, diagnostics, lambda e: e.part(kind, name))

    def installed(self) -> tuple[Extension, ...]:
        """Return what the installed packages bring, sorted by the packages' names."""
        packages = installed_packages(os.environ if self.environ is None else self.environ)
        return tuple(Extension(f"{p.kind} {p.name}", p.folder) for p in packages)

    def _only(
        self,
        what: str,
        span: Span | None,
        diagnostics: Diagnostics,
        place: Callable[[Extension], Path | None],
    ) -> Extension | None:
        found = [e for e in self.named if place(e) is not None]
        found = found or [e for e in self.installed() if place(e) is not None]
        if len(found) > 1:
            origins = " and ".join(extension.origin for extension in found)
            hint = "Remove one of them, or rename what it brings"
            diagnostics.error(f"the {what} comes from {origins}", span, hint, id="MG-4060")
        return found[0] if found else None


INSTALLED = Extensions()
"""What the installed packages bring, and nothing else."""


def take_extensions(
    application: Application, near: Path, diagnostics: Diagnostics
) -> tuple[Application, tuple[Extension, ...]]:
    """Return the folders that `components` names, and the application with the components' names in their place.

    A folder with a `component.yaml` selects that component; any other only makes known what it holds. Paths are
    relative to `near`. A folder that cannot be used is an error in `diagnostics`.
    """
    found: list[Extension] = []
    changes: list[ComponentChange] = []
    for change in application.components:
        if not is_path(change.name):
            changes.append(change)
            continue
        folder = near / change.name
        extension = Extension(f"folder {own_name(folder)}", folder, change.span)
        if extension.is_empty:
            hint = (
                f"Add {change.name.rstrip('/')}/{COMPONENT_FILE}; a path is relative to the application file"
            )
            if is_folder(folder):
                message = f"'{change.name}' contains no component, profile, platform or target"
                diagnostics.error(message, change.span, hint, id="MG-4061")
            else:
                diagnostics.error(f"'{change.name}' is not a folder", change.span, hint, id="MG-4089")
            continue
        found.append(extension)
        if extension.is_component:
            changes.append(replace(change, name=own_name(folder)))
    return replace(application, components=tuple(changes)), tuple(found)


def is_path(name: str) -> bool:
    """Return whether an item of `components` is a folder and not a component's name."""
    return "/" in name


def own_name(folder: Path) -> str:
    """Return the name of a folder, also of `.` and `..`."""
    return folder.resolve().name


def files_of(folder: Path) -> Iterator[tuple[str, Path]]:
    """Yield the files that make a component, sorted: their paths below its folder, and where they are."""
    paths = [folder / name for name in _OWN_FILES]
    paths += [path for name in _OWN_FOLDERS for path in (folder / name).rglob("*")]
    yield from ((path.relative_to(folder).as_posix(), path) for path in sorted(paths) if path.is_file())


def folders_below(folder: Path) -> Iterator[Path]:
    """Yield the folders of a component or package, sorted: their times change with what is added or removed."""
    yield folder
    for name in (*_OWN_FOLDERS, *_FOLDERS):
        top = folder / name
        yield from (p for p in (top, *sorted(top.rglob("*"))) if p.is_dir())


def digest_of(folder: Path) -> str:
    """Return a hash of everything that makes a component: what is compiled against it must be built with the same."""
    digest = hashlib.sha256()
    for name, path in files_of(folder):
        digest.update(f"{name}\0{hashlib.sha256(read_bytes(path)).hexdigest()}\n".encode())
    return digest.hexdigest()[:16]
