# SPDX-License-Identifier: Apache-2.0
"""`microros-gen package`: writes the sources of a plan as a package of another build system."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.cli.offers import package_names
from microros_gen.cli.options import interface_path_option


def _list(context: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted:
        from microros_gen.cli.package_report import package_list

        click.echo(package_list(), nl=False)
        context.exit()


@click.command()
@click.argument("name", metavar="NAME", shell_complete=package_names)
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
    required=True,
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Folder of the package, managed by the tool.",
)
@click.option("--archive", "archived", is_flag=True, help="Write DIR.zip or DIR.tar.gz, too.")
@click.option(
    "--list", is_flag=True, is_eager=True, expose_value=False, callback=_list, help="List packages."
)
def command(
    name: str, config: Path | None, interface_paths: tuple[Path, ...], output: Path, archived: bool
) -> None:
    """Write the C sources of a plan to DIR, as a package that another build system takes.

    NAME is one of `--list`, or the path of a folder with a package.yaml. The sources are right for every processor
    that the package is for; nothing is compiled. Without -c, the package has a general plan with pools of entities.

    \b
    microros-gen package cmake -o build/microros
    microros-gen package cmake -c microros.yaml -o build/microros --archive
    """
    from microros_gen.cli.package_report import write_package

    write_package(name, config, interface_paths, output, archived)
