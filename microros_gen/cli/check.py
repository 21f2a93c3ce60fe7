# SPDX-License-Identifier: Apache-2.0
"""`microros-gen check`: compares what would be generated with a golden copy."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from microros_gen import compiler
from microros_gen.cli.generate import warnings_text
from microros_gen.cli.options import selection_options, selftest_option


@click.command()
@selection_options
@selftest_option
@click.option(
    "--golden",
    required=True,
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Folder of the golden copy, under version control.",
)
@click.option("--update", is_flag=True, help="Rewrite the golden copy instead of comparing.")
def command(golden: Path, update: bool, **options: Any) -> int:
    """Generate in memory and compare with a golden copy. If they differ, print a unified diff and exit with 1.

    The version of the generator is not compared.

    \b
    microros-gen check --profile pure_sender --golden golden/pure_sender
    """
    planned = compiler.plan(compiler.resolve(compiler.read(compiler.Options(**options))))
    files = compiler.render(planned, fork=True)
    click.echo(warnings_text(planned.warnings), nl=False, err=True)
    if update:
        report = compiler.write(files, golden)
        click.echo(f"{golden}: {len(report.written)} written, {len(report.removed)} removed")
    differences = compiler.differences(files, golden)
    for difference in differences:
        click.echo(difference, nl=False)
    if differences and update:
        click.echo(
            f"{golden} holds {len(differences)} more that microros-gen did not write: remove them", err=True
        )
    elif differences:
        click.echo(f"{len(differences)} of {len(files)} files differ from {golden}", err=True)
    return 1 if differences else 0
