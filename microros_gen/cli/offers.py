# SPDX-License-Identifier: Apache-2.0
"""What a shell offers for arguments: names of profiles, targets, components, interfaces, ids and files.

Each press of Tab starts the program, so nothing here imports more than it needs (tests/cli/test_completion.py).
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from click.shell_completion import CompletionItem

from microros_gen.documents.shipped import COMPONENTS, TARGETS, profiles_folder

if TYPE_CHECKING:
    import click

    Items = list[CompletionItem[str]]

_PACKAGES = COMPONENTS.parent / "platform" / "package"


def profile_names(ctx: click.Context, param: click.Parameter, incomplete: str) -> Items:
    """Offer the profiles that are built in or installed, and files."""
    own = (path.stem for path in profiles_folder().glob("*.yaml") if path.stem != "middleware")
    return _offered({*own, *_installed("profiles", "*.yaml")}, incomplete, files=True)


def target_names(ctx: click.Context, param: click.Parameter, incomplete: str) -> Items:
    """Offer the targets that are built in or installed, and files."""
    own = (path.stem for path in TARGETS.glob("[a-z]*.yaml"))
    return _offered({*own, *_installed("targets", "[a-z]*.yaml")}, incomplete, files=True)


def component_changes(ctx: click.Context, param: click.Parameter, incomplete: str) -> Items:
    """Offer components to add (`timers`, `+timers`), and folders; click takes a text with a dash as an option."""
    own = (path.parent.name for path in COMPONENTS.glob("*/component.yaml"))
    found = {*own, *_installed("components", "*")}
    sign = "+" if incomplete.startswith("+") else ""
    return _offered({sign + name for name in found}, incomplete, files=True)


def interface_names(ctx: click.Context, param: click.Parameter, incomplete: str) -> Items:
    """Offer packages, and the types of those that the text begins to name; also those of --interface-path.

    Types follow once one package is left, so that a first Tab shows packages alone.
    """
    from microros_gen.interfaces.find import InterfaceFinder, types_in

    paths = [Path(path) for path in ctx.params.get("interface_paths") or ()]
    packages = InterfaceFinder.from_environment(paths).packages()
    start = incomplete.partition("/")[0]
    meant = [p for p in packages if p.name == start] if "/" in incomplete else packages
    meant = [p for p in meant if p.name.startswith(start)]
    names = {p.name for p in meant}
    if len(meant) == 1 or "/" in incomplete:
        names |= {str(name) for place in meant for name in types_in(place)}
    return _offered(names, incomplete)


def schema_names(ctx: click.Context, param: click.Parameter, incomplete: str) -> Items:
    """Offer the kinds of files that have a schema."""
    from microros_gen.documents.schema_files import schema_files

    return _offered(schema_files(), incomplete)


def package_names(ctx: click.Context, param: click.Parameter, incomplete: str) -> Items:
    """Offer the packages that are built in or installed, and folders."""
    return _offered({*_own_packages(), *_installed("platform/package", "*")}, incomplete, files=True)


def project_names(ctx: click.Context, param: click.Parameter, incomplete: str) -> Items:
    """Offer the packages with which `init` makes a project, those that are installed, and folders."""
    own = {
        path.parent.name for path in _PACKAGES.glob("*/package.yaml") if b"\nproject:\n" in path.read_bytes()
    }
    return _offered({*own, *_installed("platform/package", "*")}, incomplete, files=True)


def ways(ctx: click.Context, param: click.Parameter, incomplete: str) -> Items:
    """Offer the ways to build and run that `doctor` checks."""
    others = {"agent", "cmake", "colcon", *_own_packages()}
    return [*target_names(ctx, param, incomplete), *_offered(others, incomplete)]


def output_or_id(ctx: click.Context, param: click.Parameter, incomplete: str) -> Items:
    """Offer ids of diagnostics where the text begins like one, else folders."""
    if incomplete[:2].upper() == "MG":
        from microros_gen.diagnostics.explanations import identities

        return _offered(identities(), incomplete.upper())
    return [CompletionItem(incomplete, type="dir")]


def _own_packages() -> Iterator[str]:
    return (path.parent.name for path in _PACKAGES.glob("*/package.yaml"))


def _offered(names: Iterable[str], incomplete: str, files: bool = False) -> Items:
    """Return the names that begin as `incomplete` does; a path where it looks like one."""
    if files and incomplete.startswith((".", "/", "~")):
        return [CompletionItem(incomplete, type="file")]
    found = [CompletionItem(name) for name in sorted(names) if name.startswith(incomplete)]
    return found or ([CompletionItem(incomplete, type="file")] if files else [])


def _installed(folder: str, pattern: str) -> Iterator[str]:
    from microros_gen.selection.installed import installed_packages

    for package in installed_packages(os.environ):
        yield from (path.stem for path in (package.folder / folder).glob(pattern))
