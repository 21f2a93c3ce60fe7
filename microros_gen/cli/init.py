# SPDX-License-Identifier: Apache-2.0
"""`microros-gen init`: a new application folder, from a profile or from existing sources."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from stat import S_IMODE
from typing import TYPE_CHECKING

import click

from microros_gen.cli.generate import warnings_text
from microros_gen.cli.offers import profile_names, project_names, target_names
from microros_gen.cli.options import interface_path_option
from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import Diagnostics

if TYPE_CHECKING:
    from microros_gen.migrate.application_folder import NewFolder
    from microros_gen.package.description import PackageDescription


@click.command()
@click.argument("paths", type=click.Path(path_type=Path), metavar="DIR", nargs=-1)
@click.option(
    "--profile",
    "profiles",
    multiple=True,
    metavar="NAME",
    shell_complete=profile_names,
    help="Profile, built-in or a file; can be repeated. Default without --from and --from-colcon-meta: pure_sender.",
)
@click.option(
    "--target",
    metavar="NAME",
    shell_complete=target_names,
    help="Target, see `microros-gen targets`. Default: host.",
)
@click.option(
    "--from",
    "sources",
    type=click.Path(path_type=Path),
    metavar="SRC_DIR",
    help="Read the C and C++ sources of an rclc application and propose its nodes, entities and limits.",
)
@click.option(
    "--from-colcon-meta",
    "metas",
    multiple=True,
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Read the settings of a colcon.meta (RMW_UXRCE_*, UCLIENT_*, …). If several are given, the last one wins.",
)
@click.option(
    "--platform",
    metavar="NAME",
    shell_complete=project_names,
    help="Write a project of another build system: one of `microros-gen package --list`, or the folder of a package.",
)
@click.option(
    "--ci",
    "checked",
    is_flag=True,
    help="Add a golden copy of the generated code and a workflow that compares it.",
)
@click.option(
    "--migrate",
    is_flag=True,
    help="Rewrite the files that are named in place of DIR for this version: deprecated keys, and `version:`.",
)
@click.option("--dry-run", is_flag=True, help="With --migrate: print what would change, as `git diff` does.")
@interface_path_option
@click.pass_context
def command(
    context: click.Context,
    paths: tuple[Path, ...],
    profiles: tuple[str, ...],
    target: str | None,
    sources: Path | None,
    metas: tuple[Path, ...],
    platform: str | None,
    checked: bool,
    migrate: bool,
    dry_run: bool,
    interface_paths: tuple[Path, ...],
) -> int:
    """Write a new application folder: microros.yaml, main.c, CMakeLists.txt, README.md.

    Existing files are never changed. What could not be decided is marked in microros.yaml with the source file and
    line, and reported as a warning.

    \b
    microros-gen init my_robot --profile pure_sender
    microros-gen init my_robot --profile pure_reader --target qemu-mps2-an386
    microros-gen init my_robot --from old/src --from-colcon-meta old/app-colcon.meta
    microros-gen init my_robot --platform platformio --from old/src
    microros-gen init --migrate --dry-run microros.yaml
    """
    if migrate:
        others = [name for name in context.params if name not in ("paths", "migrate", "dry_run")]
        if any(context.params[name] for name in others):
            raise click.UsageError("--migrate takes no other option than --dry-run.")
        if not paths:
            raise click.UsageError("--migrate needs the files to rewrite, such as microros.yaml.")
        return _migrate(paths, dry_run)
    if dry_run:
        raise click.UsageError("--dry-run needs --migrate.")
    if not paths:
        raise click.UsageError("Missing argument 'DIR'.")
    if len(paths) > 1:
        raise click.UsageError(f"Got unexpected extra argument ({paths[1]})")
    [folder] = paths
    from microros_gen.migrate.application_folder import write_folder
    from microros_gen.migrate.proposal import InitOptions, draft_of

    if platform is not None and (target is not None or checked):
        raise click.UsageError("--platform takes neither --target nor --ci.")
    options = InitOptions(folder, profiles, target, sources, metas, interface_paths, checked)
    if platform is not None:
        options = replace(options, package=_package(platform))
    warnings = Diagnostics()
    draft = draft_of(options, warnings)
    echo_found(warnings_text(warnings))
    written = write_folder(options, draft)
    echo_found(warnings_text(written.found))
    _report(written)
    return 0 if written.builds else 2


def _migrate(paths: tuple[Path, ...], dry_run: bool) -> int:
    """Write or print files for the current version; none of them is changed if one has an error."""
    from microros_gen.migrate.current_keys import migrated_file
    from microros_gen.output.tree import write_files

    diagnostics = Diagnostics()
    files = [migrated_file(path, diagnostics) for path in paths]
    diagnostics.check()
    for file in files:
        if file is None or file.before == file.after:
            continue
        if dry_run:
            click.echo(file.difference(), nl=False)
        else:
            place = file.path.resolve()  # a link stays one
            mode = place.stat().st_mode
            write_files(place.parent, {place.name: file.content()})
            place.chmod(S_IMODE(mode))
            click.echo(f"{file.path}: written for this version")
    return 0


def _package(name: str) -> PackageDescription:
    """Return the package of a project. Raises UserError if it is unknown or has none."""
    from microros_gen.migrate.platform_project import checked_project
    from microros_gen.package.render import describe

    package = describe(name)
    checked_project(package)
    return package


def _report(written: NewFolder) -> None:
    from microros_gen.application.find import APPLICATION_FILE
    from microros_gen.migrate.draft_text import UNDECIDED

    in_library = [n for n in written.files if written.library and n.startswith(f"{written.library}/")]
    own = [n for n in written.files if not n.startswith("golden/") and n not in set(in_library)]
    click.echo(f"{written.folder}: {', '.join(own)}")
    if in_library:
        click.echo(f"package of {len(in_library)} files in {written.folder / written.library}")
    elif len(own) < len(written.files):
        click.echo(f"golden copy of {len(written.files) - len(own)} files in {written.folder / 'golden'}")
    if written.undecided:
        place = written.folder / APPLICATION_FILE
        click.echo(f"{written.undecided} to be decided by you: look for {UNDECIDED} in {place}")
    if not written.builds:
        click.echo("it does not build before the errors are gone")
        return
    for step in written.next:
        click.echo(step)
