# SPDX-License-Identifier: Apache-2.0
"""`microros-gen init`: a new application folder, from a profile or from existing sources."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from microros_gen.cli.generate import warnings_text
from microros_gen.cli.offers import profile_names, target_names
from microros_gen.cli.options import interface_path_option
from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import Diagnostics

if TYPE_CHECKING:
    from microros_gen.migrate.application_folder import NewFolder


@click.command()
@click.argument("folder", type=click.Path(path_type=Path), metavar="DIR")
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
    "--ci",
    "checked",
    is_flag=True,
    help="Add a golden copy of the generated code and a workflow that compares it.",
)
@interface_path_option
def command(
    folder: Path,
    profiles: tuple[str, ...],
    target: str | None,
    sources: Path | None,
    metas: tuple[Path, ...],
    checked: bool,
    interface_paths: tuple[Path, ...],
) -> int:
    """Write a new application folder: microros.yaml, main.c, CMakeLists.txt, README.md.

    Existing files are never changed. What could not be decided is marked in microros.yaml with the source file and
    line, and reported as a warning.

    \b
    microros-gen init my_robot --profile pure_sender
    microros-gen init my_robot --profile pure_reader --target qemu-mps2-an386
    microros-gen init my_robot --from old/src --from-colcon-meta old/app-colcon.meta
    """
    from microros_gen.migrate.application_folder import write_folder
    from microros_gen.migrate.proposal import InitOptions, draft_of

    options = InitOptions(folder, profiles, target, sources, metas, interface_paths, checked)
    warnings = Diagnostics()
    draft = draft_of(options, warnings)
    echo_found(warnings_text(warnings))
    written = write_folder(options, draft)
    echo_found(warnings_text(written.found))
    _report(written)
    return 0 if written.builds else 2


def _report(written: NewFolder) -> None:
    from microros_gen.application.find import APPLICATION_FILE
    from microros_gen.migrate.draft_text import UNDECIDED

    own = [name for name in written.files if not name.startswith("golden/")]
    click.echo(f"{written.folder}: {', '.join(own)}")
    if len(own) < len(written.files):
        click.echo(f"golden copy of {len(written.files) - len(own)} files in {written.folder / 'golden'}")
    if written.undecided:
        place = written.folder / APPLICATION_FILE
        click.echo(f"{written.undecided} to be decided by you: look for {UNDECIDED} in {place}")
    if not written.builds:
        click.echo("it does not build before the errors are gone")
        return
    click.echo(
        f"cmake -S {written.folder} -B {written.folder / 'build'} && cmake --build {written.folder / 'build'}"
    )
