# SPDX-License-Identifier: Apache-2.0
"""`microros-gen generate`: writes the sources of a selection."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from microros_gen import compiler
from microros_gen.cli.options import output_option, selection_options, selftest_option
from microros_gen.cli.terminal import echo_found, echo_summary, next_step
from microros_gen.output.runs import Run, compiled_templates, find_run, record_run

if TYPE_CHECKING:
    from microros_gen.diagnostics import Diagnostic
    from microros_gen.output.tree import WriteReport


_NOT_OF_BUILD = ("depfile", "default_target")
"""Options for build systems, which `build` does not have."""


@click.command()
@selection_options
@selftest_option
@output_option
@click.option(
    "--depfile",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="Write a dependency file for make, Ninja and CMake: the inputs of the output.",
)
@click.option(
    "--default-target",
    metavar="NAME",
    hidden=True,
    help="For build systems: target if nothing else selects one and this name is built in.",
)
@click.pass_context
def command(ctx: click.Context, /, output: Path | None, depfile: Path | None, **options: Any) -> None:
    """Write the C sources of a selection to OUT, without compiling.

    Only files with new content are written; files that are no longer selected are removed.

    \b
    microros-gen generate --profile pure_sender --interface sensor_msgs/msg/Imu
    """
    call = {"command": "generate", "output": output, "depfile": depfile, **options}
    last = find_run(call, os.environ)
    if last is not None:
        echo_found(last.warnings)
        echo_summary(last.summary + _files_line(last.out, 0, last.files, 0))
        _compile_next(ctx)
        return
    started_ns = time.time_ns()
    from microros_gen.documents.templates import compile_ahead

    compile_ahead(compiled_templates(os.environ))
    request = compiler.read(compiler.Options(**options))
    from microros_gen.cli.summary import plan_summary
    from microros_gen.output.depfile import write_depfile
    from microros_gen.output.tree import JOURNAL, MANIFEST

    resolved = compiler.resolve(request)
    out = compiler.output_folder(resolved, output)
    planned = compiler.plan(resolved)
    warnings = warnings_text(planned.warnings)
    echo_found(warnings)
    report = compiler.write(compiler.render(planned, fork=True), out)
    summary = plan_summary(planned)
    files = report.written + report.unchanged
    run = Run(out, summary, len(files), warnings)
    inputs = tuple(compiler.read_paths(planned))
    outputs = [f"{out}/{name}" for name in files]
    if depfile is not None:
        write_depfile(depfile, out / MANIFEST, inputs)
        outputs.append(str(depfile))
    record_run(call, os.environ, run, (*inputs, out / JOURNAL), outputs, started_ns)
    echo_summary(summary + files_line(out, report))
    _compile_next(ctx)


def _compile_next(ctx: click.Context) -> None:
    """Print the command that compiles the same selection."""
    words = ["microros-gen", "build"]
    for parameter in ctx.command.params:
        typed = ctx.get_parameter_source(parameter.name or "") is click.core.ParameterSource.COMMANDLINE
        if typed and parameter.name not in _NOT_OF_BUILD:
            value = ctx.params[parameter.name or ""]
            name = parameter.opts[-1]
            if isinstance(value, bool):
                words.append(name)
            else:
                words += [
                    w for v in (value if isinstance(value, tuple) else (value,)) for w in (name, str(v))
                ]
    next_step(words)


def warnings_text(warnings: Iterable[Diagnostic]) -> str:
    """Return what was found and is no error, as it goes to stderr."""
    return "".join(f"{warning.render()}\n" for warning in warnings)


def files_line(out: Path, report: WriteReport) -> str:
    """Return the line that says what was done to the files of `out`."""
    line = _files_line(out, len(report.written), len(report.unchanged), len(report.removed))
    return line + "".join(
        f"{'kept':<10} {name}: no longer selected, but changed by somebody else\n" for name in report.kept
    )


def _files_line(out: Path, written: int, unchanged: int, removed: int) -> str:
    return f"{'files':<10} {written} written, {unchanged} unchanged, {removed} removed in {out}\n"
