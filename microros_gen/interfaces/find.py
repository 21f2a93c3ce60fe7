# SPDX-License-Identifier: Apache-2.0
"""Where interface files are found and how they are read.

Four kinds of places are searched in this order: the user's paths (`--interface-path`), the prefixes of
AMENT_PREFIX_PATH, the packages that pip installed (`sys.prefix`), and the set that ships with this tool. A
package that is found in one place hides the same package in all later places.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from enum import Enum
from pathlib import Path
from types import MappingProxyType

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.documents.files import is_file, is_folder, read_bytes, read_text
from microros_gen.interfaces.msg.names import is_package_name
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

SUFFIXES_OF_KIND: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {"msg": (".msg", ".idl"), "srv": (".srv", ".idl"), "action": (".action", ".idl")}
)
"""The interface files that are read: kind, which is also the folder that holds them → suffixes, best first.

ROS 2 installs an .idl file besides what it is made from; an .idl file alone is an interface that was written so.
"""

KINDS = tuple(SUFFIXES_OF_KIND)
"""The kinds of interfaces."""

_IGNORED = ("COLCON_IGNORE", "AMENT_IGNORE")
_DEEPEST = 5
_PACKAGE_NAME = re.compile(r"<name>\s*([a-z][a-z0-9_]*)\s*</name>")


class Origin(Enum):
    """The kind of place where a package was found, in the order of the search."""

    PATH = "path"
    AMENT = "ament"
    PIP = "pip"
    SHIPPED = "shipped"


@dataclass(frozen=True)
class PackagePlace:
    """One package: `folder` is the one that holds `msg/`, `srv/` or `action/`, printed as the user gave it."""

    name: str
    folder: Path
    origin: Origin


@dataclass(frozen=True)
class InterfaceFinder:
    """Finds packages and reads their interface files. It holds only where to look; it keeps nothing that it
    read.

    `paths`: folders that the user named, each a package, a folder of packages or a colcon workspace. `ament`:
    prefixes, in order. `pip`: prefixes of Python environments. `shipped`: the folder of the definitions that
    come with the tool.
    """

    paths: tuple[Path, ...] = ()
    ament: tuple[Path, ...] = ()
    pip: tuple[Path, ...] = ()
    shipped: Path | None = None

    @staticmethod
    def from_environment(
        paths: Iterable[Path] = (),
        environ: Mapping[str, str] | None = None,
        prefix: Path | None = None,
    ) -> InterfaceFinder:
        """Return the finder of a run: `paths`, then AMENT_PREFIX_PATH of `environ`, `prefix`, the shipped
        set.

        `environ` is `os.environ` and `prefix` is `sys.prefix` unless given.
        """
        environment = os.environ if environ is None else environ
        ament = [Path(p) for p in environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
        return InterfaceFinder(
            paths=tuple(paths),
            ament=tuple(ament),
            pip=(Path(sys.prefix) if prefix is None else prefix,),
            shipped=shipped_folder(),
        )

    def packages(self) -> tuple[PackagePlace, ...]:
        """Return every package that holds interface files, by name, each at its first place."""
        found: dict[str, PackagePlace] = {}
        for folder, origin in self._roots():
            for place in _packages_below(folder, origin):
                found.setdefault(place.name, place)
        return tuple(found[name] for name in sorted(found))

    def package(self, name: str) -> PackagePlace | None:
        """Return the first place of package `name`, or None where no place has it."""
        return next(self.places(name), None)

    def places(self, name: str) -> Iterator[PackagePlace]:
        """Give every place of package `name`; the first one counts and hides the others."""
        for folder, origin in self._roots() if is_package_name(name) else ():
            if origin is not Origin.PATH:
                if _is_package(folder / name):
                    yield PackagePlace(name, folder / name, origin)
            elif _is_package(folder / name) and _name_of(folder / name) == name:
                yield PackagePlace(name, folder / name, origin)
            else:
                yield from (place for place in _packages_below(folder, origin) if place.name == name)

    def types(self, package: str) -> tuple[TypeName, ...]:
        """Return the interface types of `package` that can be read, sorted; empty where it is unknown."""
        place = self.package(package)
        return types_in(place) if place is not None else ()

    def read(self, name: TypeName, diagnostics: Diagnostics) -> Source | None:
        """Return the text of type `name`, or None if the file does not exist or cannot be read.

        A file that exists and is not UTF-8 or not readable is an error in `diagnostics`.
        """
        place = self.package(name.package)
        if place is None:
            return None
        return read_type(place, name, diagnostics)

    def own_packages(self) -> Mapping[str, tuple[PackagePlace, ...]]:
        """Return the packages of the user's paths by name, with their places in the first path that has them.

        More than one place is ambiguous: ROS 2 takes a name once.
        """
        found: dict[str, tuple[PackagePlace, ...]] = {}
        for path in self.paths:
            places: dict[str, list[PackagePlace]] = {}
            for place in _packages_below(path, Origin.PATH):
                places.setdefault(place.name, []).append(place)
            found = {**{name: tuple(found_places) for name, found_places in places.items()}, **found}
        return found

    def check_paths(self, diagnostics: Diagnostics, spans: Mapping[Path, Span | None] | None = None) -> None:
        """Report each of the user's paths that is not a folder, cannot be read or holds no interface package.

        `spans` has the places of those that a file names.
        """
        for path in self.paths:
            fault = _path_fault(path)
            if fault is not None:
                span = spans.get(path) if spans else None
                diagnostics.error(f"the interface path '{path}' {fault[0]}", span, fault[1], id="MG-2010")

    def searched(self) -> str:
        """Return where the search looks, in words, for a diagnostic."""
        places = [str(path) for path in self.paths]
        places += [f"{prefix / 'share'} (AMENT_PREFIX_PATH)" for prefix in self.ament]
        places += [f"{prefix / 'share'} (pip)" for prefix in self.pip]
        if self.shipped is not None:
            places.append("the definitions that ship with microros-gen")
        return ", ".join(places) if places else "nowhere: no place was given"

    def deciding(self, packages: Iterable[str]) -> Iterator[Path]:
        """Yield the paths that decide where `packages` are found, those that are missing too.

        While none of them changes (a folder: its names), the search has the same result.
        """
        names = tuple(packages)
        for folder, origin in self._roots():
            yield folder
            if origin is Origin.PATH:  # any folder may hold any package: its package.xml has the name
                walked = [folder, *_walk(folder)]
                yield from (path for here in walked for path in (here, here / "package.xml"))
            else:
                yield from (folder / name for name in names)

    def _roots(self) -> Iterator[tuple[Path, Origin]]:
        yield from ((path, Origin.PATH) for path in self.paths)
        yield from ((prefix / "share", Origin.AMENT) for prefix in self.ament)
        yield from ((prefix / "share", Origin.PIP) for prefix in self.pip)
        if self.shipped is not None:
            yield self.shipped, Origin.SHIPPED


def shipped_folder() -> Path:
    """Return the folder of the definitions that come with this tool."""
    return Path(__file__).resolve().parent.parent / "idl"


def types_in(place: PackagePlace) -> tuple[TypeName, ...]:
    """Return the types in `place` that can be read, sorted by kind and name."""
    return tuple(
        TypeName(place.name, kind, stem)
        for kind, suffixes in sorted(SUFFIXES_OF_KIND.items())
        for stem in _stems(place.folder / kind, suffixes)
    )


def read_type(place: PackagePlace, name: TypeName, diagnostics: Diagnostics) -> Source | None:
    """Read the file of type `name` in `place`; None if none exists or, with an error, no text."""
    for suffix in SUFFIXES_OF_KIND.get(name.kind, ()):
        path = place.folder / name.kind / f"{name.name}{suffix}"
        try:
            data = read_bytes(path)
        except FileNotFoundError:
            continue
        except OSError as fault:
            diagnostics.error(
                f"cannot read '{path}': {fault.strerror}", hint="Check the file's permissions", id="MG-2011"
            )
            return None
        return _text_of(path, data, diagnostics)
    return None


def _text_of(path: Path, data: bytes, diagnostics: Diagnostics) -> Source | None:
    try:
        return Source(str(path), data.decode("utf-8"))
    except UnicodeDecodeError as fault:
        before = data[: fault.start].decode("utf-8")
        source = Source(str(path), data.decode("utf-8", errors="replace"))
        place = Span(source, before.count("\n") + 1, len(before) - before.rfind("\n"))
        diagnostics.error(
            f"the file is not UTF-8: byte 0x{data[fault.start]:02x}",
            place,
            "Save the file as UTF-8, which is what ROS 2 reads",
            id="MG-2012",
        )
        return None


def _stems(folder: Path, suffixes: tuple[str, ...]) -> list[str]:
    try:
        entries = [entry for entry in folder.iterdir() if not entry.name.startswith(".")]
        return sorted({entry.stem for entry in entries if entry.suffix in suffixes})
    except OSError:
        return []


def _is_package(folder: Path) -> bool:
    return any(is_folder(folder / kind) for kind in KINDS)


def _packages_below(folder: Path, origin: Origin) -> list[PackagePlace]:
    if origin is not Origin.PATH:
        return [PackagePlace(c.name, c, origin) for c in _children(folder) if _is_package(c)]
    if _is_package(folder):
        return [PackagePlace(_name_of(folder), folder, origin)]
    found = (c for c in _walk(folder) if _is_package(c) and (c.parent == folder or _has_manifest(c)))
    return [PackagePlace(_name_of(c), c, origin) for c in found]


def _walk(folder: Path) -> Iterator[Path]:
    """Yield the folders below `folder` that can be packages, in the order of their paths.

    As colcon looks for them in a workspace: not in hidden folders, nor below a package or a folder that says
    COLCON_IGNORE, which build, install and log do.
    """
    pending = [(entry, 1) for entry in reversed(_children(folder))]
    while pending:
        here, depth = pending.pop()
        if (
            here.name.startswith(".")
            or not is_folder(here)
            or any((here / name).exists() for name in _IGNORED)
        ):
            continue
        yield here
        if depth < _DEEPEST and not _is_package(here) and not _has_manifest(here):
            pending += [(entry, depth + 1) for entry in reversed(_children(here))]


def _has_manifest(folder: Path) -> bool:
    return is_file(folder / "package.xml")


def _children(folder: Path) -> list[Path]:
    try:
        return sorted(folder.iterdir())
    except OSError:
        return []


def _name_of(folder: Path) -> str:
    """Return the name in the folder's package.xml (REP-149), or the folder's own."""
    try:
        manifest = read_text(folder / "package.xml")
    except (OSError, UnicodeDecodeError):
        return folder.resolve().name
    match = _PACKAGE_NAME.search(manifest)
    return match.group(1) if match else folder.resolve().name


def _path_fault(path: Path) -> tuple[str, str] | None:
    if not is_folder(path) and not is_file(path) and not os.path.lexists(path):
        return "does not exist", "Name a folder that holds interface packages, or one package"
    if not is_folder(path):
        return "is not a folder", "Name the package's folder, the one that holds msg/, srv/ or action/"
    try:
        next(path.iterdir(), None)
    except OSError as fault:
        return f"cannot be read: {fault.strerror}", "Check the folder's permissions"
    if _packages_below(path, Origin.PATH):
        return None
    for child in _children(path):
        ignored = next((name for name in _IGNORED if (child / name).exists()), None)
        if ignored is not None and _is_package(child):
            return "contains no interface package", f"'{child}' has a file {ignored}: name this folder itself"
    return (
        "contains no interface package",
        "A package has a folder msg/, srv/ or action/; itself, a folder of packages or a workspace can be named",
    )
