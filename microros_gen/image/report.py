# SPDX-License-Identifier: Apache-2.0
"""Everything that `size` shows of an output folder, measured once."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from elftools.common.exceptions import DWARFError, ELFError

from microros_gen.diagnostics import Diagnostic, Source, Span, UserError
from microros_gen.image.attribution import Chunk, attribute, attribute_library
from microros_gen.image.budget import BudgetLine, advice_hint, advice_lines, budget_lines, exceeded_message
from microros_gen.image.callgraph import CallGraph, build_call_graph
from microros_gen.image.dwarf import Facts, Part, read_facts, read_variables
from microros_gen.image.elf import Elf
from microros_gen.image.entities import Entity, RamPart, entities, ram_parts
from microros_gen.image.folder import Folder, read_folder
from microros_gen.image.link_time import refuse_remade
from microros_gen.image.stack import StackReport, shown_name, stack_report
from microros_gen.records import dataclass

_CALL = re.compile(r"\b([a-z]\w*)\(")
_PRIVATE = "microros"
"""The folder of headers that applications need not include."""


@dataclass(frozen=True)
class SizeReport:
    """What an output folder takes. Without an image the parts are those of every object of the library."""

    folder: Folder
    chunks: tuple[Chunk, ...]
    facts: Facts
    ram: tuple[RamPart, ...]
    entities: tuple[Entity, ...]
    graph: CallGraph | None
    stack: StackReport
    budgets: tuple[BudgetLine, ...]

    @property
    def mapped(self) -> bool:
        """Whether the linker left a map; a library needs none."""
        return self.folder.image is None or bool(self.folder.placed)

    @property
    def totals(self) -> Mapping[str, int]:
        """Bytes of text, data and bss, as `size` counts them."""
        return {kind: sum(p.size for p in self.chunks if p.kind == kind) for kind in ("text", "data", "bss")}

    @property
    def variables(self) -> int:
        """Bytes of static RAM of all parts."""
        return sum(chunk.ram for chunk in self.chunks)

    @property
    def library_variables(self) -> int:
        """Those of the library, which a `ram_budget` limits."""
        return _static_ram(self.chunks)


def measure(path: Path, image: Path | None = None, linker_map: Path | None = None) -> SizeReport:
    """Measure an output folder, or the image of a user's that was linked with its library.

    `path`, `image` and `linker_map` are as `locate` takes them. UserError where there is nothing that was built, or
    files are not what they should be.
    """
    return measure_folder(read_folder(path, image, linker_map))


def measure_folder(folder: Folder, image: Elf | None = None) -> SizeReport:
    """Measure what was read. UserError where the image, or an object of it, is no whole ELF file.

    `image`: that of the folder, for a caller that reads more of it; what was read of it is not read again.
    """
    try:
        if folder.image is None:
            return _measure_library(folder)
        return _measure_image(folder, Elf(folder.image) if image is None else image)
    except (ELFError, DWARFError) as error:
        what = f"{folder.image or folder.path} cannot be measured: {error}"
        raise UserError([Diagnostic(what, hint="Link it again", id="MG-8413")], status=1) from error


def static_memory(folder: Folder) -> int:
    """Return the static memory of the library in what was built, bytes; much faster than to measure everything."""
    chunks = attribute_library(folder) if folder.image is None else attribute(folder, Elf(folder.image))
    return _static_ram(chunks)


def _static_ram(chunks: Iterable[Chunk]) -> int:
    return sum(chunk.ram for chunk in chunks if chunk.owner.group in ("component", "type support"))


def _measure_image(folder: Folder, image: Elf) -> SizeReport:
    chunks = attribute(folder, image)
    if folder.linked is not None:
        _check_plan(folder, image, chunks)
    facts = read_facts(image)
    parts = ram_parts(folder, chunks, facts)
    graph = build_call_graph(folder, image, chunks)
    stack = stack_report(graph, image, public_functions(folder, chunks))
    budgets = budget_lines(folder, chunks, parts, stack)
    return SizeReport(folder, chunks, facts, parts, entities(folder, chunks, parts), graph, stack, budgets)


def _check_plan(folder: Folder, image: Elf, chunks: Iterable[Chunk]) -> None:
    """Refuse an image of another plan: each library and each application refer to the symbol of theirs.

    Where both were optimized at link time, that symbol is not left.
    """
    suffix = f"__plan_{folder.manifest['plan']}"
    if not any(symbol.name.endswith(suffix) for symbol in image.symbols):
        refuse_remade(folder, chunks)
        what = f"{image.path} was not linked with the library of {folder.path} as it is now"
        raise UserError(
            [Diagnostic(what, hint="Link it again, or give the folder of its library", id="MG-8414")]
        )


def public_functions(folder: Folder, chunks: Iterable[Chunk]) -> frozenset[str]:
    """Return the functions of the library in the image that a public header declares."""
    declared: set[str] = set()
    for path in sorted((folder.path / "include").rglob("*.h")):
        if path.relative_to(folder.path / "include").parts[0] != _PRIVATE:
            declared.update(_CALL.findall(path.read_text(encoding="utf-8", errors="replace")))
    of_components = (p.symbol for p in chunks if p.function and p.symbol and p.owner.group == "component")
    return frozenset(name for name in of_components if shown_name(name) in declared)


def check_budgets(
    budgets: Iterable[BudgetLine], places: Mapping[str, Span | None], keys: Mapping[str, int]
) -> None:
    """Raise UserError with status 1 when a budget is exceeded.

    `places` are where the application sets them, `keys` the lines of its top-level keys.
    """
    found = [
        Diagnostic(
            exceeded_message(line),
            places.get(line.key) or _span(line),
            advice_hint(line),
            block=advice_lines(line, keys),
            id="MG-8415",
        )
        for line in budgets
        if line.exceeded
    ]
    if found:
        raise UserError(found, status=1)


def _measure_library(folder: Folder) -> SizeReport:
    chunks = attribute_library(folder)
    facts = _library_facts(folder, chunks)
    parts = ram_parts(folder, chunks, facts)
    stack = StackReport(False, "without an image, calls are not linked yet", 0, None, (), (), 0)
    budgets = budget_lines(folder, chunks, parts, stack)
    return SizeReport(folder, chunks, facts, parts, entities(folder, chunks, parts), None, stack, budgets)


def _library_facts(folder: Folder, chunks: Iterable[Chunk]) -> Facts:
    """Return types and parts of the variables of the library's objects."""
    types: dict[int, str] = {}
    parts: dict[int, tuple[Part, ...]] = {}
    known: dict[str, Mapping[str, tuple[str, tuple[Part, ...]]]] = {}
    for chunk in chunks:
        if chunk.ram and chunk.symbol and chunk.source:
            if chunk.source not in known:
                item = folder.object(chunk.source)
                known[chunk.source] = read_variables(item) if item is not None else {}
            found = known[chunk.source].get(chunk.symbol.partition(".")[0])
            if found:
                types[chunk.address], parts[chunk.address] = found
    return Facts(types, parts, {})


def _span(line: BudgetLine) -> Span | None:
    """Return the place that the manifest names; the application file itself is not at hand."""
    if not line.place:
        return None
    name, _, number = line.place.rpartition(":")
    return Span(Source(name, ""), int(number), 1)
