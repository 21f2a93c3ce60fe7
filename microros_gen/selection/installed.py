# SPDX-License-Identifier: Apache-2.0
"""Packages of ament and pip that bring components, profiles or parts of platforms.

An ament package registers itself in the ament index as a resource of the type `microros_gen_components`; the file's
text is its folder below the prefix, `share/<package>` where it is empty. A pip package has an entry point of the group
`microros_gen.components` whose value is the Python package with the folders. Neither is imported.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from microros_gen.documents.files import is_folder, read_text
from microros_gen.records import dataclass

RESOURCE = "microros_gen_components"
GROUP = "microros_gen.components"
_INDEX = Path("share/ament_index/resource_index") / RESOURCE


@dataclass(frozen=True)
class InstalledPackage:
    """A package: `kind` is `ament package` or `pip package`; `folder` has its components, profiles and parts."""

    kind: str
    name: str
    folder: Path


def installed_packages(environ: Mapping[str, str]) -> tuple[InstalledPackage, ...]:
    """Return the packages that bring something, by name; one of ament hides one of pip with the same name."""
    found: dict[str, InstalledPackage] = {}
    for package in (*_of_ament(environ), *_of_pip()):
        found.setdefault(package.name.replace("-", "_").lower(), package)
    return tuple(found[name] for name in sorted(found))


def index_folders(environ: Mapping[str, str]) -> tuple[Path, ...]:
    """Return the folders in which ament packages are registered, whether they exist or not."""
    prefixes = environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return tuple(Path(prefix) / _INDEX for prefix in prefixes if prefix)


def _of_ament(environ: Mapping[str, str]) -> Iterator[InstalledPackage]:
    for index in index_folders(environ):
        prefix = index.parents[3]
        for entry in sorted(index.iterdir()) if is_folder(index) else ():
            below = _text(entry) or f"share/{entry.name}"
            yield InstalledPackage("ament package", entry.name, prefix / below)


def _text(path: Path) -> str:
    try:
        return read_text(path).strip()
    except (OSError, UnicodeDecodeError):
        return ""


def _of_pip() -> Iterator[InstalledPackage]:
    from importlib.metadata import entry_points

    for entry in entry_points(group=GROUP):
        folder = _module_folder(entry.module)
        name = entry.dist.name if entry.dist is not None else entry.name
        if folder is not None:
            yield InstalledPackage("pip package", name, folder)


def _module_folder(module: str) -> Path | None:
    """Return the folder of a Python package; what its top level has below it is taken by name, not imported."""
    from importlib.util import find_spec

    top, *below = module.split(".")
    try:
        spec = find_spec(top)
    except (ImportError, ValueError):
        return None
    places = list(spec.submodule_search_locations or ()) if spec is not None else []
    return next((f for f in (Path(p, *below) for p in places) if is_folder(f)), None)
