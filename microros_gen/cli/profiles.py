# SPDX-License-Identifier: Apache-2.0
"""`microros-gen profiles [NAME]`: what profiles there are, and what one of them selects."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.cli.offers import profile_names
from microros_gen.cli.tables import FORMATS, format_selection


@click.command()
@click.argument("name", required=False, shell_complete=profile_names)
@click.option(
    "--format",
    "kind",
    type=click.Choice(FORMATS),
    default="table",
    show_default=True,
    help="Tables, JSON, or a graph for Graphviz.",
)
def command(name: str | None, kind: str) -> None:
    """List the profiles, or show what profile NAME (built-in or a file) selects by itself.

    \b
    microros-gen profiles
    microros-gen profiles pure_sender
    microros-gen profiles ./my_profile.yaml --format json
    """
    from microros_gen.cli.profile_lists import list_profiles, listed_profiles, select_profile
    from microros_gen.selection.find_components import load_catalogue

    catalogue = load_catalogue()
    if name is None:
        click.echo(list_profiles(listed_profiles(), catalogue, kind), nl=False)
    else:
        click.echo(format_selection(select_profile(name, Path(), catalogue), kind), nl=False)
