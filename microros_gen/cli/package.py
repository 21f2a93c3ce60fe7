# SPDX-License-Identifier: Apache-2.0
"""`microros-gen package`: writes the sources of a plan as a package of another build system."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from microros_gen.cli.offers import package_names
from microros_gen.cli.options import interface_path_option


def _required(context: click.Context, parameter: click.Parameter, value: Any) -> Any:
    """Return the value of what is needed unless packages are listed; `--list` is read first."""
    if value is None and not context.params["listed"]:
        raise click.MissingParameter(ctx=context, param=parameter)
    return value


@click.command()
@click.argument("name", metavar="NAME", required=False, callback=_required, shell_complete=package_names)
@click.option(
    "-c",
    "--config",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Application file of a project. Default: the general plan of the package, for many applications.",
)
@interface_path_option
@click.option(
    "-o",
    "--output",
    callback=_required,
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Folder of the package, managed by the tool.  [required]",
)
@click.option("--archive", "archived", is_flag=True, help="Write DIR.zip or DIR.tar.gz, too.")
@click.option("--list", "listed", is_flag=True, is_eager=True, help="List the packages, or NAME alone.")
def command(
    name: str | None,
    config: Path | None,
    interface_paths: tuple[Path, ...],
    output: Path | None,
    archived: bool,
    listed: bool,
) -> None:
    """Write the C sources of a plan to DIR, as a package that another build system takes.

    NAME is one of `--list`, or the path of a folder with a package.yaml. The sources are right for every processor
    that the package is for; nothing is compiled. Without -c, the package has a general plan with pools of entities.

    \b
    microros-gen package cmake -o build/microros
    microros-gen package cmake -c microros.yaml -o build/microros --archive
    """
    from microros_gen.cli.package_report import package_list, write_package

    if listed:
        click.echo(package_list(name), nl=False)
        return
    assert name is not None
    assert output is not None
    write_package(name, config, interface_paths, output, archived)
