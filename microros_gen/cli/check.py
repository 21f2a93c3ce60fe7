# SPDX-License-Identifier: Apache-2.0
"""`microros-gen check`: compares what would be generated with a golden copy."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from microros_gen.cli.options import selection_options
from microros_gen.compiler.options import SelectionOptions
from microros_gen.compiler.pipeline import plan_request, render_request, resolve_request, warnings_text
from microros_gen.compiler.request import read_request
from microros_gen.diagnostics import Diagnostics
from microros_gen.output.golden import golden_differences
from microros_gen.output.tree import write_tree


@click.command()
@selection_options
@click.option(
    "--golden",
    required=True,
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="The folder of the golden copy, under version control.",
)
@click.option("--update", is_flag=True, help="Rewrite the golden copy instead of comparing.")
def command(golden: Path, update: bool, **options: Any) -> int:
    """Generate in memory and compare with a golden copy; exit 1 and a unified diff where it differs.

    The generator's version is left out of the comparison.

    \b
    microros-gen check --profile pure_sender --golden golden/pure_sender
    """
    diagnostics = Diagnostics()
    selection = SelectionOptions(**options)
    resolved = resolve_request(read_request(selection, diagnostics), diagnostics)
    files = render_request(plan_request(resolved, selection, diagnostics))
    click.echo(warnings_text(diagnostics), nl=False, err=True)
    if update:
        report = write_tree(golden, files)
        click.echo(f"{golden}: {len(report.written)} written, {len(report.removed)} removed")
    differences = golden_differences(golden, files)
    for difference in differences:
        click.echo(difference, nl=False)
    if differences and update:
        click.echo(
            f"{golden} holds {len(differences)} more that microros-gen did not write: remove them", err=True
        )
    elif differences:
        click.echo(f"{len(differences)} of {len(files)} files differ from {golden}", err=True)
    return 1 if differences else 0
