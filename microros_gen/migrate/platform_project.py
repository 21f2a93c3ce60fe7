# SPDX-License-Identifier: Apache-2.0
"""The files of a project for another build system: the package of the plan, the sources, what builds both."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterator, Mapping
from pathlib import Path

from microros_gen import __version__
from microros_gen.application.find import APPLICATION_FILE
from microros_gen.compiler import Planned
from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.documents.files import read_bytes
from microros_gen.documents.own_templates import render_own
from microros_gen.documents.templates import shared_environment
from microros_gen.migrate.code import (
    COMPILED,
    code_files,
    code_folder,
    include_folders,
    included_headers,
    read_all,
    text_of,
)
from microros_gen.migrate.proposal import InitOptions, source_places
from microros_gen.package.description import PROJECT_FOLDER, PackageDescription
from microros_gen.package.project import Project
from microros_gen.package.render import PackagePlan, render_package
from microros_gen.records import dataclass
from microros_gen.selection.component_sources import template_name

_LARGEST = 1 << 20
_WRITTEN = (("NAME", "{name}"), ("DOT_", "."))
"""Placeholders in paths below project/: for the name of the project, and for a dot at their beginning."""


@dataclass(frozen=True)
class ProjectView:
    """What the templates below project/ of a package print, as `view`.

    `folder` is the name of the project's folder, `library` the folder of the package in it. `sources` are the paths of
    all sources in the project, `names` below the folder of the sources; `first` is the one of `names` that has the
    entry function, `rest_c` and `rest_cpp` are the others of the two languages. `folders` are those in which the
    sources find their headers, below the folder of the sources, which is the first one (`.`). `includes` are all
    headers that they name. `update` is the command that writes the package again, `undecided` lines say what is left to
    the user.
    """

    name: str
    folder: str
    version: str
    package: str
    summary: str
    library: str
    sources: tuple[str, ...]
    names: tuple[str, ...]
    first: str
    rest_c: tuple[str, ...]
    rest_cpp: tuple[str, ...]
    folders: tuple[str, ...]
    includes: tuple[str, ...]
    update: str
    next: tuple[str, ...]
    undecided: tuple[str, ...]


def checked_project(package: PackageDescription) -> Project:
    """Return what a project with a package consists of. Raises UserError if it has none."""
    if package.project is None:
        hint = "Leave --platform out: `init` writes a project of CMake"
        message = f"the package {package.name} has no project"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9013")])
    return package.project


def project_files(options: InitOptions, planned: Planned | None, undecided: int) -> dict[str, bytes]:
    """Return the files of a project besides the application file; without a plan, without the package.

    Raises UserError if a source cannot be read.
    """
    package = options.package
    assert package is not None
    project = checked_project(package)
    files: dict[str, bytes] = {}
    if planned is not None:
        library = project.place_of_library(options.name)
        rendered = render_package(PackagePlan(package, planned, general=False))
        files = {f"{library}/{name}": content for name, content in rendered.items()}
    places, found = source_places(options), Diagnostics()
    contents = read_all(places, found)
    found.check()
    files |= {places[path]: content for path, content in contents.items()}
    view = _view(options, package, project, places, undecided)
    files["README.md"] = (
        shared_environment().get_template("init/platform_README.md.j2").render(view=view).encode()
    )
    files |= dict(_own(package, view))
    return files


def find_needs(options: InitOptions, planned: Planned, diagnostics: Diagnostics) -> None:
    """Warn of what the platform wants of a program and its sources do not have."""
    assert options.package is not None
    assert options.code is not None
    project = checked_project(options.package)
    texts = [text_of(path) for path in code_files(options.code)]
    for need in project.needs_of(planned.project.selection.transport):
        if not need.is_met(texts):
            names = " or ".join(f"{name}()" for name in need.functions)
            message = f"a program for {options.package.name} needs {names}, which these sources do not have"
            diagnostics.warning(message, hint=need.hint, id="MG-9014")


def next_steps(options: InitOptions) -> tuple[str, ...]:
    """Return the commands that build the project, from the current folder."""
    assert options.package is not None
    folder = shlex.quote(str(options.folder))
    steps = checked_project(options.package).next
    return tuple(step.replace("{dir}", folder).replace("{name}", options.name) for step in steps)


def _view(
    options: InitOptions,
    package: PackageDescription,
    project: Project,
    places: Mapping[Path, str],
    undecided: int,
) -> ProjectView:
    assert options.code is not None
    start = project.sources.replace("{name}", options.name)
    compiled = {place: path for path, place in places.items() if path.suffix in COMPILED}
    names = tuple(place.removeprefix(start) for place in sorted(compiled))
    entries = [n for n in names if project.entry.is_met([text_of(compiled[f"{start}{n}"])])]
    first = (entries or [*names, ""])[0]
    rest = [name for name in names if name != first]
    paths = "".join(
        f" --interface-path {shlex.quote(_relative(p, options))}" for p in options.interface_paths
    )
    library = project.place_of_library(options.name)
    return ProjectView(
        name=options.name,
        folder=options.folder.resolve().name,
        version=__version__,
        package=package.name,
        summary=package.summary,
        library=library,
        sources=tuple(sorted(compiled)),
        names=names,
        first=first,
        rest_c=tuple(name for name in rest if name.endswith(".c")),
        rest_cpp=tuple(name for name in rest if not name.endswith(".c")),
        folders=_folders(options.code),
        includes=included_headers(options.code),
        update=f"microros-gen package {_named(options, package)} -c {APPLICATION_FILE}{paths} -o {library}",
        next=tuple(step.replace("{dir}", ".").replace("{name}", options.name) for step in project.next),
        undecided=(f"{undecided} places of {APPLICATION_FILE}, marked UNDECIDED",) * bool(undecided),
    )


def _folders(code: Path) -> tuple[str, ...]:
    """Return the folders of sources and headers below that of the sources, which is the first one."""
    found = (path.relative_to(code_folder(code)).as_posix() for path in include_folders(code))
    return (".", *(folder for folder in found if folder != "."))


def _named(options: InitOptions, package: PackageDescription) -> str:
    """Return how a command in the project names the package: a folder of the user's by its path."""
    path = _relative(package.folder, options)
    if not package.origin.startswith("folder"):
        return package.name
    return path if "/" in path else f"./{path}"


def _relative(path: Path, options: InitOptions) -> str:
    return Path(os.path.relpath(path, options.folder)).as_posix()


def _own(package: PackageDescription, view: ProjectView) -> Iterator[tuple[str, bytes]]:
    """Yield the files below project/, templates rendered."""
    folder = package.folder / PROJECT_FOLDER
    environment = shared_environment()
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        place = path.relative_to(folder).as_posix()
        for written, meant in _WRITTEN:
            place = place.replace(written, meant.replace("{name}", view.name))
        if path.suffix != ".j2":
            yield place, read_bytes(path, _LARGEST)
            continue
        name, context = template_name(path), {"view": view}
        text = (
            environment.get_template(name).render(context) if name else render_own(path, environment, context)
        )
        yield place.removesuffix(".j2"), text.encode()
