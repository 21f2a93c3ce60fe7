# SPDX-License-Identifier: Apache-2.0
"""What `microros-gen package` writes and prints; apart from the command, since it imports the compiler."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen import compiler
from microros_gen.cli.generate import files_line, warnings_text
from microros_gen.cli.summary import table
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.output.tree import check_owned, write_files
from microros_gen.package.archive import archive
from microros_gen.package.description import PackageDescription
from microros_gen.package.find import builtin_packages
from microros_gen.package.render import PackagePlan, describe, plan_package, render_package
from microros_gen.package.view import buffers_of, package_view


def package_list(name: str | None = None) -> str:
    """Return a line for each package that ships with the tool, or for package `name` alone.

    Raises UserError if that does not exist.
    """
    names = builtin_packages() if name is None else (name,)
    return table([(each, describe(each).summary) for each in names])


def write_package(
    name: str, config: Path | None, interface_paths: tuple[Path, ...], output: Path, archived: bool
) -> None:
    """Write a package to `output`, and an archive next to it; print what it has and what is next.

    Raises UserError for what is wrong with the name, the application or the folder.
    """
    package = describe(name)
    check_owned(output)
    place = _archive_of(output, package.archive) if archived else None
    plan = plan_package(package, config, interface_paths)
    click.echo(warnings_text(plan.planned.warnings), nl=False, err=True)
    files = render_package(plan)
    report = compiler.write(files, output)
    click.echo(_summary(plan) + files_line(output, report), nl=False)
    steps = [_next(package.next_folder, output)]
    if place is not None:
        write_files(place.parent, {place.name: archive(files, package.library, package.archive)})
        steps = [("archive", str(place)), _next(package.next_archive or package.next_folder, place)]
    click.echo(table([step for step in steps if step[1]]), nl=False)


def _archive_of(output: Path, kind: str) -> Path:
    """Return the path of the archive next to the folder. Raises UserError if a folder has it."""
    folder = output if output.name not in ("", "..") else output.resolve()
    place = folder.with_name(f"{folder.name}.{kind}")
    if place.is_dir():
        hint = "Choose another output folder with -o, or rename the folder"
        raise UserError([Diagnostic(f"the archive {place} is a folder", hint=hint, id="MG-9209")])
    return place


def _next(text: str, result: Path) -> tuple[str, str]:
    return "next", text.replace("{out}", str(result))


def _summary(plan: PackagePlan) -> str:
    package, project = plan.package, plan.planned.project
    view = package_view(package, plan.planned, plan.general, ())
    what = "general plan" if plan.general else f"plan of {project.name}"
    lines = [
        ("package", f"{package.name}: {package.summary}"),
        ("plan", f"{what}: {len(view.components)} components, {', '.join(view.interfaces)}"),
        ("RAM", _ram(plan)),
    ]
    if view.functions:
        lines.append(("you define", f"{', '.join(view.functions)} (README.md has their declarations)"))
    return table(lines)


def _ram(plan: PackagePlan) -> str:
    """Return what the buffers of the plan take; with the user's plan, also those of the general one."""
    buffers = buffers_of(plan.planned)
    text = f"{sum(b.bytes for b in buffers)} bytes of buffers"
    text += f" ({', '.join(f'{b.name} {b.bytes}' for b in buffers)})"
    return text if plan.general else f"{text}; the general plan: {_general_ram(plan.package)}"


def _general_ram(package: PackageDescription) -> str:
    return f"{sum(b.bytes for b in buffers_of(plan_package(package, None).planned))} bytes"
