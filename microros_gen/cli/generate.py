# SPDX-License-Identifier: Apache-2.0
"""`microros-gen generate`: writes the sources of a selection."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from microros_gen.cli.options import SelectionOptions, output_option, selection_options
from microros_gen.cli.pipeline import Planned, plan_request, print_warnings, read_request, render_request
from microros_gen.cli.pipeline import resolve_request as resolve_step
from microros_gen.cli.summary import generated_summary
from microros_gen.diagnostics import Diagnostics
from microros_gen.output.tree import WriteReport, check_owned, write_tree


@click.command()
@selection_options
@output_option
def command(output: Path | None, **options: Any) -> None:
    """Write the C sources of a selection to OUT, without compiling.

    Only files whose content changes are touched; files that are no longer selected are removed.

    \b
    microros-gen generate --profile pure_sender --interface sensor_msgs/msg/Imu
    """
    planned, out, report = generate(SelectionOptions(**options), output)
    click.echo(generated_summary(planned, out, report), nl=False)


def generate(options: SelectionOptions, output: Path | None) -> tuple[Planned, Path, WriteReport]:
    """Plan, render and write; return the plan, the folder and what was done to it."""
    diagnostics = Diagnostics()
    resolved = resolve_step(read_request(options, diagnostics), diagnostics)
    out = output or Path("build") / "+".join(resolved.selection.profiles)
    check_owned(out)
    planned = plan_request(resolved, options, diagnostics)
    report = write_tree(out, render_request(planned))
    print_warnings(diagnostics)
    return planned, out, report
