# SPDX-License-Identifier: Apache-2.0
"""The files of a new application folder: all of them decided first, then written, none of them over another."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path

from microros_gen import __version__, compiler
from microros_gen.application.find import APPLICATION_FILE
from microros_gen.application.parser import SCHEMA as APPLICATION_SCHEMA
from microros_gen.client.views.example_file import render_example
from microros_gen.compiler import Planned
from microros_gen.diagnostics import Diagnostic, Diagnostics, Source, UserError
from microros_gen.documents.schema_files import complete_schema, modeline, schema_text
from microros_gen.documents.templates import shared_environment
from microros_gen.migrate.code import c_sources, include_folders
from microros_gen.migrate.draft import Draft, DraftValue, report_remarks
from microros_gen.migrate.draft_text import draft_text
from microros_gen.migrate.limits import LOWER_LIMITS
from microros_gen.migrate.platform_project import find_needs, next_steps, project_files
from microros_gen.migrate.proposal import InitOptions
from microros_gen.output.tree import write_files
from microros_gen.package.render import plan_request
from microros_gen.records import dataclass

SCHEMA_FILE = "microros.schema.json"
"""The schema of the application file, next to it: editors read it without the tool and without a network."""

WORKFLOW = ".github/workflows/microros.yml"
_TEMPLATES = {
    "CMakeLists.txt": "CMakeLists.txt.j2",
    "README.md": "README.md.j2",
    ".gitignore": "gitignore.j2",
    WORKFLOW: "workflow.yml.j2",
}


@dataclass(frozen=True)
class _View:
    """What the templates below templates/init print."""

    name: str
    version: str
    target: str
    toolchain: bool
    languages: str
    has_image: bool
    package: str
    sources: tuple[str, ...]
    include_folders: tuple[str, ...]
    own_sources: bool
    code: str
    interface_paths: str
    check_options: str
    agent: str
    undecided: int
    golden: bool
    checked: bool


@dataclass(frozen=True)
class NewFolder:
    """What `write_folder` wrote, by paths below the folder; `undecided` places are left to the user.

    `builds`: the application plans as it is. `found` are warnings, and the errors for which it does not. `library` is
    the folder of a package in it; `next` are the commands that build it.
    """

    folder: Path
    files: tuple[str, ...]
    undecided: int
    builds: bool
    found: tuple[Diagnostic, ...]
    library: str = ""
    next: tuple[str, ...] = ()


def write_folder(options: InitOptions, draft: Draft) -> NewFolder:
    """Write the folder of `draft`, which need not build when it was proposed from what there was.

    Raises UserError, and writes nothing, where a file is in the way or where a profile alone does not plan.
    """
    undecided = [remark for remark in draft.all_remarks if remark.undecided]
    with _made(options.folder):
        text, planned, found = _planned(options, draft)
        if planned is None and not options.adopts:
            found.check()
        report_remarks(undecided, found)
        try:
            files = _files(options, text, planned, len(undecided))
        except UserError as error:
            found.extend(error.diagnostics)
            raise UserError(found) from error
        _refuse_to_overwrite(options.folder, files)
        write_files(options.folder, files)
    builds = planned is not None and not any(remark.refused for remark in undecided)
    written = NewFolder(options.folder, tuple(sorted(files)), len(undecided), builds, tuple(found))
    project = options.package.project if options.package is not None else None
    if project is None:
        folder = shlex.quote(str(options.folder))
        return replace(
            written, next=(f"cmake -S {folder} -B {folder}/build && cmake --build {folder}/build",)
        )
    return replace(written, library=project.place_of_library(options.name), next=next_steps(options))


@contextmanager
def _made(folder: Path) -> Iterator[None]:
    """Make the folder, which paths of the application file start at; take it away again where it stays empty."""
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        hint = "Name a new folder" if folder.is_file() else "Name a folder that can be written"
        message = f"cannot create the folder {folder}: {error.strerror}"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9001")]) from error
    try:
        yield
    except UserError:
        for path in missing:
            with suppress(OSError):
                path.rmdir()
        raise


def _heading(options: InitOptions) -> list[str]:
    lines = [
        modeline(SCHEMA_FILE).removeprefix("# "),
        f"What {options.name} has; `microros-gen resolve` says what follows from it.",
    ]
    read = [str(path) for path in (options.sources, *options.metas) if path is not None]
    if read:
        lines += [f"Proposed by `microros-gen init` from {', '.join(read)}."]
    return lines


def _planned(options: InitOptions, draft: Draft) -> tuple[str, Planned | None, Diagnostics]:
    """Return the text of the proposal, its plan and what was found: the first of the proposals that plans."""
    first = _attempt(options, draft)
    _, planned, found = first
    if planned is not None or not any(diagnostic.too_large for diagnostic in found):
        return first
    for changed in _smaller_or_with_room(draft, found):
        attempt = _attempt(options, changed)
        if attempt[1] is not None:
            return attempt
    return first


def _attempt(options: InitOptions, draft: Draft) -> tuple[str, Planned | None, Diagnostics]:
    text, found = draft_text(draft, _heading(options)), Diagnostics()
    return text, _plan(options, text, found), found


def _smaller_or_with_room(draft: Draft, found: Iterable[Diagnostic]) -> Iterator[Draft]:
    """Yield the proposal with lower limits for "*", then with a larger MTU, for messages that do not fit."""
    if "*" in draft.limits:
        yield from (replace(draft, limits={**draft.limits, "*": lower}) for lower in LOWER_LIMITS)
    transport = draft.groups.get("transport", {})
    largest = max((diagnostic.mtu for diagnostic in found), default=0)
    if largest and "mtu" not in transport:
        mtu = DraftValue(largest, "bytes of the largest message that is not sent in fragments")
        yield replace(draft, groups={"transport": {**transport, "mtu": mtu}, **_without_transport(draft)})


def _without_transport(draft: Draft) -> dict[str, Mapping[str, DraftValue]]:
    return {name: values for name, values in draft.groups.items() if name != "transport"}


def _plan(options: InitOptions, text: str, diagnostics: Diagnostics) -> Planned | None:
    """Return the plan of the proposal, or None with what is against it in `diagnostics`."""
    source = Source(str(options.folder / APPLICATION_FILE), text)
    try:
        request = compiler.read_source(source, options.folder, options.compiler_options())
        if options.package is None:
            planned = compiler.plan(compiler.resolve(request))
        else:
            planned = plan_request(options.package, request).planned
            find_needs(options, planned, diagnostics)
    except UserError as error:
        diagnostics.extend(error.diagnostics)
        return None
    diagnostics.extend(planned.warnings)
    return planned


def _files(options: InitOptions, text: str, planned: Planned | None, undecided: int) -> dict[str, bytes]:
    """Return the files to write, by their path below the folder."""
    schema = schema_text(complete_schema(APPLICATION_SCHEMA))
    files = {APPLICATION_FILE: text.encode(), SCHEMA_FILE: schema.encode()}
    if options.package is not None:
        return files | project_files(options, planned, undecided)
    environment = shared_environment()
    toolchain = None
    if planned is not None:
        rendered = compiler.render(planned)
        if options.checked:
            files |= {f"golden/{name}": content for name, content in rendered.items()}
        toolchain = rendered.get("toolchain.cmake")
        if options.sources is None:
            heading = f"What {options.name} does."
            files["main.c"] = render_example(planned.project, environment, heading)
    if toolchain is not None:
        files["toolchain.cmake"] = toolchain
    view_of_folder = _view(options, planned, toolchain is not None, undecided)
    for name, template in _TEMPLATES.items():
        if name == WORKFLOW and not options.checked:
            continue
        files[name] = environment.get_template(f"init/{template}").render(view=view_of_folder).encode()
    return files


def _view(options: InitOptions, planned: Planned | None, toolchain: bool, undecided: int) -> _View:
    project = planned.project if planned is not None else None
    sources = c_sources(options.sources) if options.sources is not None else ()
    shown = tuple(_relative(path, options.folder) for path in sources) or ("main.c",)
    paths = [_relative(path, options.folder) for path in options.interface_paths]
    discovery = project is not None and project.selection.has("discovery")
    return _View(
        name=options.name,
        version=__version__,
        target=project.target.name if project else options.target or "host",
        toolchain=toolchain,
        languages="C CXX" if any(not name.endswith(".c") for name in shown) else "C",
        has_image=project is None or project.target.has_image,
        package=project.target.package if project and not project.target.hosted else "",
        sources=shown,
        include_folders=tuple(_relative(path, options.folder) for path in include_folders(options.sources))
        if options.sources is not None
        else (),
        own_sources=bool(sources),
        code=f"`{_relative(options.sources, options.folder)}`" if options.sources is not None else "`main.c`",
        interface_paths="".join(f' "{path}"' for path in paths),
        check_options="".join(f" --interface-path {shlex.quote(path)}" for path in paths),
        agent="udp4 --port 8888" + (" --discovery" if discovery else ""),
        undecided=undecided,
        golden=planned is not None,
        checked=options.checked,
    )


def _relative(path: Path, folder: Path) -> str:
    return Path(os.path.relpath(path, folder)).as_posix()


def _refuse_to_overwrite(folder: Path, files: Mapping[str, bytes]) -> None:
    existing = sorted(name for name in files if (folder / name).exists())
    if existing:
        shown = ", ".join(existing[:3]) + (f" and {len(existing) - 3} more" if len(existing) > 3 else "")
        message = f"{folder} already has files that would be written: {shown}"
        raise UserError(
            [
                Diagnostic(
                    message, hint="Name a new folder, or move them away; nothing was changed", id="MG-9002"
                )
            ]
        )
