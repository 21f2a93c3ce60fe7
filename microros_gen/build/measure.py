# SPDX-License-Identifier: Apache-2.0
"""Measures what was built: section sizes of the library, against the application's budget."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from microros_gen.build.compile import LIBRARY
from microros_gen.build.toolchain import Toolchain, run, sibling
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.model.application import Memory


@dataclass(frozen=True)
class ObjectUsage:
    """Bytes of one object of the library."""

    name: str
    flash: int
    ram: int


@dataclass(frozen=True)
class Usage:
    """Bytes of the library: `flash` is code, constants and initial values; `ram` is data and bss."""

    flash: int
    ram: int
    objects: tuple[ObjectUsage, ...]


def measure_library(out: Path, tools: Toolchain) -> Usage | None:
    """Return what `size` says of the library; None where the tool chain has no `size`."""
    program = sibling(tools.archiver, "ar", "size")
    if program is None:
        return None
    result = run([program, "-B", LIBRARY], out)
    if result.returncode != 0:
        return None
    objects = []
    for line in result.stdout.splitlines()[1:]:
        parts = line.split()
        text, data, bss, name = int(parts[0]), int(parts[1]), int(parts[2]), parts[5]
        objects.append(ObjectUsage(name, text + data, data + bss))
    return Usage(sum(o.flash for o in objects), sum(o.ram for o in objects), tuple(objects))


def check_budget(usage: Usage, memory: Memory) -> None:
    """Raise UserError with status 1 when a budget is exceeded; it names the largest contributors."""
    found = []
    ram = [(o.ram, o.name) for o in usage.objects]
    flash = [(o.flash, o.name) for o in usage.objects]
    for budget, used, key, span, parts in (
        (memory.ram_budget, usage.ram, "ram_budget", memory.ram_span, ram),
        (memory.flash_budget, usage.flash, "flash_budget", memory.flash_span, flash),
    ):
        if budget is not None and used > budget:
            largest = sorted(parts, reverse=True)[:3]
            names = ", ".join(f"{name.removesuffix('.o')} {size}" for size, name in largest)
            message = f"the library takes {used} bytes and memory.{key} is {budget} (largest: {names})"
            hint = "Lower pools.history, limits or pools, or raise the budget"
            found.append(Diagnostic(message, span, hint))
    if found:
        raise UserError(found, status=1)
