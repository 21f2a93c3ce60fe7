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
@click.option(
    "--package",
    metavar="NAME",
    help="The golden copy is a package, as `microros-gen package` writes it; of the other options, -c and"
    " --interface-path are for packages.",
)
def command(golden: Path, update: bool, package: str | None, **options: Any) -> int:
    """Generate in memory and compare with a golden copy. If they differ, print a unified diff and exit with 1.

    The version of the generator is not compared.

    \b
    microros-gen check --profile pure_sender --golden golden/pure_sender
    microros-gen check --package cmake --golden libraries/microros
    """
    files, warnings = (
        _generated(compiler.Options(**options)) if package is None else _packed(package, options)
    )
    click.echo(warnings_text(warnings), nl=False, err=True)
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


def _generated(options: compiler.Options) -> tuple[dict[str, bytes], tuple[compiler.Diagnostic, ...]]:
    planned = compiler.plan(compiler.resolve(compiler.read(options)))
    return compiler.render(planned, fork=True), planned.warnings


def _packed(name: str, options: dict[str, Any]) -> tuple[dict[str, bytes], tuple[compiler.Diagnostic, ...]]:
    """Return the files of a package, which takes two of the options."""
    from microros_gen.package.render import describe, plan_package, render_package

    config, interface_paths = options.pop("config"), options.pop("interface_paths")
    if any(options.values()):
        raise click.UsageError("--package takes only -c and --interface-path.")
    plan = plan_package(describe(name), config, interface_paths)
    return render_package(plan), plan.planned.warnings
