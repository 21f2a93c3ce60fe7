# SPDX-License-Identifier: Apache-2.0
"""`microros-gen build`: generates and compiles."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import click

from microros_gen import compiler
from microros_gen.cli.generate import files_line, warnings_text
from microros_gen.cli.options import output_option, selection_options, selftest_option
from microros_gen.cli.terminal import Progress, echo_found, echo_summary, next_step
from microros_gen.output.runs import compiled_templates


@click.command()
@selection_options
@selftest_option
@output_option
def command(output: Path | None, **options: Any) -> None:
    """Generate a selection, compile it to OUT/lib/libmicroros.a and link the profile's example to OUT/bin.

    Only changed files are compiled again. For the host, CC, AR and CFLAGS are taken from the environment.
    Budgets of the application file (memory.ram_budget, flash_budget, stack) are checked afterwards. If one is
    exceeded, the exit status is 1 and the error lists what would reduce it. `microros-gen size OUT` shows the figures.

    \b
    microros-gen build --profile pure_sender
    microros-gen build -c microros.yaml -o build/robot
    """
    from microros_gen.documents.templates import compile_ahead

    compile_ahead(compiled_templates(os.environ))
    from microros_gen.cli.summary import built_summary, plan_summary, runs_here, selftest_summary
    from microros_gen.output.tree import check_build_folders

    request = compiler.read(compiler.Options(**options))
    resolved = compiler.resolve(request)
    out = compiler.output_folder(resolved, output)
    planned = compiler.plan(resolved)
    echo_found(warnings_text(planned.warnings))
    tools = compiler.toolchain(planned)
    check_build_folders(out)
    report = compiler.write(compiler.render(planned, fork=True), out)
    echo_summary(plan_summary(planned) + files_line(out, report))
    with Progress() as progress:
        built = compiler.compile(planned, out, tools, progress)
    echo_summary(built_summary(out, built.report, built.usage, planned.project.lacks_image))
    if planned.resolved.request.selftest:
        echo_summary(selftest_summary(out, built.report, planned.project))
    if planned.project.application.memory.has_budget or planned.project.stack_meets_variables:
        from microros_gen.cli.budgets import check_planned
        from microros_gen.image.folder import read_folder

        check_planned(planned, lambda: read_folder(out))
    next_step(["microros-gen", "run" if runs_here(planned.project, built.report) else "size", str(out)])
