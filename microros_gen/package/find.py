# SPDX-License-Identifier: Apache-2.0
"""Finds packages: those that ship with the tool, those of installed packages, and a folder by its path."""

from __future__ import annotations

from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source, nearest
from microros_gen.documents.files import is_file, read_text, reason_of
from microros_gen.package.description import PACKAGE_FILE, PackageDescription, files_of, parse_package
from microros_gen.selection.extension import INSTALLED, Extensions, own_name
from microros_gen.selection.find_components import parts_folder

KIND = "package"
"""The folder below `platform/`, in the tool and in what brings further ones."""


def builtin_packages() -> tuple[str, ...]:
    """Return the names of the packages that ship with the tool, sorted."""
    return tuple(sorted(path.parent.name for path in (parts_folder() / KIND).glob(f"*/{PACKAGE_FILE}")))


def read_package(
    name: str, diagnostics: Diagnostics, extensions: Extensions = INSTALLED
) -> PackageDescription | None:
    """Read a package by its name, or from a folder by its path (with a / in it).

    A name that is not built in is looked for in `extensions`. None and errors in `diagnostics` if nothing has it or
    its package.yaml is wrong.
    """
    found = _find(name, diagnostics, extensions)
    if found is None:
        return None
    folder, origin = found
    path = folder / PACKAGE_FILE
    try:
        source = Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        hint = (
            f"Available: {', '.join(builtin_packages())}; or give the path of a folder with a {PACKAGE_FILE}"
        )
        diagnostics.error(f"cannot read '{path}': {reason_of(error)}", hint=hint, id="MG-9203")
        return None
    taken, span = files_of(source)
    known = tuple(each for each in builtin_packages() if each != folder.name)
    if taken and taken not in known:
        hint = nearest(taken, known) or f"Available: {', '.join(known)}"
        diagnostics.error(f"unknown package '{taken}'", span, hint, id="MG-9208")
        return None
    base = read_package(taken, diagnostics, extensions) if taken else None
    return parse_package(source, folder, origin, diagnostics, base)


def _find(name: str, diagnostics: Diagnostics, extensions: Extensions) -> tuple[Path, str] | None:
    """Return the folder of a package, and who brings it."""
    if "/" in name or "\\" in name:
        return Path(name), f"folder {own_name(Path(name))}"
    known = builtin_packages()
    if name in known:
        return parts_folder() / KIND / name, ""
    for extension in extensions.installed():
        folder = extension.folder / "platform" / KIND / name
        if is_file(folder / PACKAGE_FILE):
            return folder, extension.origin
    hint = nearest(name, known) or f"Available: {', '.join(known)}; or give the path of a folder, ./{name}"
    diagnostics.error(f"unknown package '{name}'", hint=hint, id="MG-9201")
    return None
