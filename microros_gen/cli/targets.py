# SPDX-License-Identifier: Apache-2.0
"""`microros-gen targets`: what can be built for."""

from __future__ import annotations

import dataclasses
import json
import shutil
from fractions import Fraction
from pathlib import Path
from typing import Any

import click

from microros_gen.cli.offers import target_names as offered_targets
from microros_gen.cli.tables import format_table
from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.platform.find import FoundTarget, read_target, target_names
from microros_gen.platform.part import Part
from microros_gen.platform.target import Emulator, Region, Target, Uart, UniqueId

_COLUMNS = ("target", "what", "image", "needs")


@click.command()
@click.argument("name", required=False, shell_complete=offered_targets)
@click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "json", "cmake")),
    default="table",
    show_default=True,
    help="Tables, JSON, or the CMake toolchain file of NAME.",
)
def command(name: str | None, kind: str) -> None:
    """List the targets, or show target NAME (built-in or the path of a target file).

    For each target, the list shows what `build` creates from the example (an image, or only the library), and the
    Debian packages that are missing on this machine.

    \b
    microros-gen targets
    microros-gen targets qemu-mps2-an386
    microros-gen targets boards/mine.yaml
    microros-gen targets cortex-m4f --format cmake > toolchain.cmake
    """
    diagnostics = Diagnostics()
    names = target_names() if name is None else (name,)
    found = [read_target(n, Path(), None, diagnostics) for n in names]
    diagnostics.check()
    known = [f for f in found if f is not None]
    targets = [f.target for f in known]
    if kind == "cmake":
        click.echo(_toolchain(targets[0] if name else None), nl=False)
    elif kind == "json":
        click.echo(json.dumps([_data(f) for f in known], indent=2, sort_keys=True))
    elif name is None:
        click.echo(format_table(_COLUMNS, [_line(f) for f in known]), nl=False)
    else:
        click.echo(format_table(("key", "value"), _rows(targets[0])), nl=False)


def _toolchain(target: Target | None) -> bytes:
    hint = "For example: microros-gen targets cortex-m4f --format cmake"
    if target is None:
        raise UserError(
            [Diagnostic("a tool-chain file is for one target: NAME is missing", hint=hint, id="MG-9721")]
        )
    if target.hosted:
        what = (
            f"target {target.name} has no tool-chain file: CMake finds the compiler of this machine by itself"
        )
        raise UserError([Diagnostic(what, hint=hint, id="MG-9722")])
    from microros_gen.client.views.board import render_toolchain
    from microros_gen.documents.templates import shared_environment

    return render_toolchain(target, shared_environment())


def missing_packages(target: Target) -> tuple[str, ...]:
    """Return the Debian packages of the tool chain and of the emulator that are not installed here."""
    missing: list[str] = []
    if not all(any(shutil.which(p) for p in names) for names in (target.compilers, target.archivers)):
        missing += target.package.split()
    emulator = target.emulator
    if emulator is not None and shutil.which(emulator.program) is None:
        missing.append(emulator.package)
    return tuple(missing)


def _line(found: FoundTarget) -> tuple[str, str, str, str]:
    target = found.target
    image = "library alone" if not target.has_image else "runs here" if target.hosted else "on the board"
    if target.emulator is not None:
        image = f"in {target.emulator.program}"
    missing = missing_packages(target)
    return (
        target.name,
        f"{target.summary} (from {found.origin})" if found.origin else target.summary,
        image,
        f"apt-get install {' '.join(missing)}" if missing else "nothing more",
    )


def _data(found: FoundTarget) -> dict[str, Any]:
    target = found.target
    parts = {part.kind: part.component.name for part in target.parts}
    data = dataclasses.asdict(dataclasses.replace(target, parts=()))
    origin = {"from": found.origin} if found.origin else {}
    cycles = target.cycles_per_instruction
    data["cycles_per_instruction"] = None if cycles is None else float(cycles)
    return {**data, **origin, "parts": parts, "missing_packages": missing_packages(target)}


def _rows(target: Target) -> list[tuple[str, str]]:
    rows = [(field.name, _text(getattr(target, field.name))) for field in dataclasses.fields(target)]
    return [*rows, ("missing packages", _text(missing_packages(target)))]


def _text(value: object) -> str:
    if isinstance(value, Fraction):
        return f"{float(value):g}"
    if isinstance(value, Region):
        return f"{value.origin:#010x}, {value.size} bytes"
    if isinstance(value, Uart):
        return f"{value.driver} at {value.base:#010x}, interrupt {value.irq}"
    if isinstance(value, UniqueId):
        return f"{value.words} words at {value.address:#010x}"
    if isinstance(value, Emulator):
        return " ".join((value.program, *value.arguments))
    if isinstance(value, Part):
        return f"{value.component.name} ({value.kind})"
    if isinstance(value, tuple):
        pairs = [f"{a} {b:#010x}" if isinstance(b, int) else f"{a} {b}" for a, b in _pairs(value)]
        return " ".join(map(_text, value)) if not pairs else ", ".join(pairs)
    return "-" if value is None else str(value)


def _pairs(values: tuple[object, ...]) -> list[tuple[object, object]]:
    return [(v[0], v[1]) for v in values if isinstance(v, tuple)]
