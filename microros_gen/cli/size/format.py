# SPDX-License-Identifier: Apache-2.0
"""The sizes of an output folder as tables and as JSON (schema: size.schema.json). The same folder, the same text."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from typing import Any

from microros_gen.cli.tables import format_table
from microros_gen.image.attribution import GROUPS, Chunk
from microros_gen.image.budget import BudgetLine
from microros_gen.image.entities import Entity, constant_uses
from microros_gen.image.report import SizeReport
from microros_gen.image.stack import Bound, StackReport, shown_name

_SHOWN_FUNCTIONS = 8
UNMAPPED_NOTE = (
    "what has no symbol, and objects of which nothing is known, are not attributed (link with -Wl,-Map=FILE)"
)

Row = tuple[str | tuple[str, ...], ...]


def owner_sizes(chunks: Iterable[Chunk]) -> list[tuple[str, str, int, int]]:
    """Return group, name, flash and RAM of each owner: by group, the largest first."""
    found: dict[tuple[str, str], list[int]] = {}
    for chunk in chunks:
        sizes = found.setdefault((chunk.owner.group, chunk.owner.name), [0, 0])
        sizes[0] += chunk.flash
        sizes[1] += chunk.ram
    rows = [(group, name, flash, ram) for (group, name), (flash, ram) in found.items()]
    return sorted(rows, key=lambda r: (GROUPS.index(r[0]), -r[2] - r[3], r[1]))


def ram_uses(report: SizeReport) -> list[tuple[str, str, int]]:
    """Return what static memory is for: group, use, bytes; the library first, the largest first."""
    found: dict[tuple[str, str], int] = {}
    for part in report.ram:
        found[part.group, part.use] = found.get((part.group, part.use), 0) + part.size
    rows = [(group, use, size) for (group, use), size in found.items()]
    return sorted(rows, key=lambda r: (GROUPS.index(r[0]), -r[2], r[1]))


def symbol_rows(report: SizeReport) -> list[tuple[int, int, str, str, str, str]]:
    """Return flash, RAM, symbol, group, owner and place of every piece, the largest first; equal ones joined."""
    found: dict[tuple[str, str, str, str], list[int]] = {}
    for chunk in report.chunks:
        name = shown_name(chunk.symbol) if chunk.symbol else f"({chunk.input or chunk.section})"
        place = chunk_place(report, chunk)
        sizes = found.setdefault((name, chunk.owner.group, chunk.owner.name, place), [0, 0])
        sizes[0] += chunk.flash
        sizes[1] += chunk.ram
    rows = [(flash, ram, *key) for key, (flash, ram) in found.items()]
    return sorted(rows, key=lambda r: (-r[0] - r[1], r[2:]))


def chunk_place(report: SizeReport, chunk: Chunk) -> str:
    """Return `src/session/xrce_session.c:31`, without the line where nobody knows it."""
    place = report.facts.places.get(chunk.address) if chunk.symbol else None
    if place and place.line and place.file:
        return f"{report.folder.shown_file(place.file)}:{place.line}"
    return chunk.source or ""


def size_table(report: SizeReport, every: bool) -> str:
    """Return the tables; with `every`, all symbols at the end."""
    parts = [
        _headline(report),
        format_table(("GROUP", "NAME", "FLASH", "RAM"), _owner_rows(report)),
        format_table(("RAM OF", "USE", "BYTES"), [(g, u, str(s)) for g, u, s in ram_uses(report)]),
        _constant_table(report),
        _entity_table(report.entities),
        _stack_table(report.stack),
        _budget_table(report.budgets),
    ]
    if every:
        rows = [(str(f), str(r), s, o, p) for f, r, s, _, o, p in symbol_rows(report)]
        parts.append(format_table(("FLASH", "RAM", "SYMBOL", "OF", "PLACE"), rows))
    return "\n".join(part for part in parts if part)


def size_json(report: SizeReport) -> str:
    """Return everything, with sorted keys."""
    return json.dumps(size_data(report), indent=2, sort_keys=True, ensure_ascii=False) + "\n"


def size_data(report: SizeReport) -> dict[str, Any]:
    """Return everything as data for JSON; size.schema.json tells the keys."""
    manifest, totals = report.folder.manifest, report.totals
    return {
        "version": 1,
        "measured": "image" if report.folder.image else "library",
        "image": str(report.folder.image) if report.folder.linked else None,
        "mapped": report.mapped,
        "target": manifest["target"],
        "plan": manifest["plan"],
        "totals": {**totals, "flash": totals["text"] + totals["data"], "ram": totals["data"] + totals["bss"]},
        "owners": [
            {"group": g, "name": n, "flash": f, "ram": r} for g, n, f, r in owner_sizes(report.chunks)
        ],
        "symbols": [
            {"flash": f, "ram": r, "name": n, "group": g, "owner": o, "place": p}
            for f, r, n, g, o, p in symbol_rows(report)
        ],
        "ram": [
            {"symbol": shown_name(p.symbol), "path": p.path, "bytes": p.size, "group": p.group, "use": p.use}
            for p in report.ram
        ],
        "constants": [
            {"owner": owner, "use": use, "bytes": flash, "ram": ram}
            for owner, use, flash, ram in constants(report)
        ],
        "entities": [_entity_data(e) for e in report.entities],
        "stack": _stack_data(report.stack),
        "budgets": [budget_data(line) for line in report.budgets],
    }


def budget_data(line: BudgetLine) -> dict[str, Any]:
    """Return a budget as data for JSON."""
    return {
        "key": f"memory.{line.key}",
        "what": line.what,
        "used": line.used,
        "budget": line.budget,
        "percent": line.percent,
        "exceeded": line.exceeded,
        "place": line.place,
        "largest": [{"name": name, "bytes": size} for name, size in line.largest],
        "advice": [asdict(a) for a in line.advice],
    }


def _headline(report: SizeReport) -> str:
    manifest, totals = report.folder.manifest, report.totals
    what = f"Image {report.folder.image_name} for {manifest['target']}"
    if not report.folder.image:
        what = f"Library for {manifest['target']}, before unused parts are dropped (the target has no image)"
    flash, ram = totals["text"] + totals["data"], totals["data"] + totals["bss"]
    sizes = f"text {totals['text']}, data {totals['data']}, bss {totals['bss']}"
    note = "" if report.mapped else f"The linker map is missing: {UNMAPPED_NOTE}\n"
    return f"{what}: {flash} bytes of flash, {ram} of RAM ({sizes})\n{note}"


def _owner_rows(report: SizeReport) -> list[tuple[str, str, str, str]]:
    rows = [(g, n, str(f), str(r)) for g, n, f, r in owner_sizes(report.chunks)]
    flash, ram = sum(p.flash for p in report.chunks), sum(p.ram for p in report.chunks)
    return [*rows, ("total", "", str(flash), str(ram))]


def constants(report: SizeReport) -> list[tuple[str, str, int, int]]:
    """Return what components say that their constants are for: component, use, bytes of flash and of RAM."""
    found = constant_uses(report.folder, report.chunks)
    return sorted((owner, use, *sizes) for (owner, use), sizes in found.items())


def _constant_table(report: SizeReport) -> str:
    rows = [(owner, use, str(flash), str(ram)) for owner, use, flash, ram in constants(report)]
    return format_table(("CONSTANTS OF", "USE", "FLASH", "RAM"), rows) if rows else ""


def _entity_table(entities: Iterable[Entity]) -> str:
    rows = []
    for entity in entities:
        shares = ", ".join(f"{s.what} {s.bytes} ({_users(s.users)})" for s in entity.shares)
        code = f"{entity.flash} ({_users(entity.type_users)})" if entity.type_users else "-"
        message = str(entity.message) if entity.message else "-"
        rows.append(
            (entity.kind, entity.name, entity.type or "-", str(entity.ram), message, code, shares or "-")
        )
    head = ("ENTITY", "NAME", "TYPE", "OWN RAM", "MESSAGES", "TYPE'S FLASH", "SHARED RAM")
    return format_table(head, rows) if rows else ""


def _users(count: int) -> str:
    return "its own" if count == 1 else f"shared by {count}"


def _stack_table(stack: StackReport) -> str:
    if not stack.known:
        return f"Stack: no bound, {stack.why}\n"
    bounds = [b for b in (stack.main, *stack.handlers) if b] + list(stack.functions[:_SHOWN_FUNCTIONS])
    rows: list[Row] = [(b.kind, b.name, f"{b.bytes}{' +' if b.open else ''}", _chain_cell(b)) for b in bounds]
    lines = [format_table(("STACK", "FROM", "BYTES", "WORST CHAIN"), rows)]
    more = len(stack.functions) - _SHOWN_FUNCTIONS
    if more > 0:
        lines.append(f"and {more} public functions that need less (--format json has all)\n")
    hardware = f", {stack.hardware} of them by the processor's own rules" if stack.hardware else ""
    lines.append(f"Worst stack with every interrupt on top: {stack.total} bytes{hardware}\n")
    if stack.open:
        lines.append(f"+ not counted: {', '.join(stack.open)}\n")
    return "".join(lines)


def chain_text(bound: Bound) -> str:
    """Return `main 16 → rcl_publish 32 → …`."""
    return " → ".join(f"{link.name} {link.frame}" for link in bound.chain)


def _chain_cell(bound: Bound) -> tuple[str, ...]:
    """Return a line a function for the start and interrupts; for a public function the way in short."""
    if bound.kind != "function":
        return tuple(f"{'→ ' if i else ''}{link.name} {link.frame}" for i, link in enumerate(bound.chain))
    names = [link.name for link in bound.chain]
    return (" → ".join(names if len(names) < 5 else [*names[:3], "…", names[-1]]),)


def _budget_table(lines: Iterable[BudgetLine]) -> str:
    rows = [
        (
            f"memory.{b.key}",
            str(b.used),
            str(b.budget),
            f"{b.percent} %{' EXCEEDED' if b.exceeded else ''}",
            b.what,
        )
        for b in lines
    ]
    return format_table(("BUDGET", "USED", "OF", "", "WHAT"), rows) if rows else ""


def _entity_data(entity: Entity) -> dict[str, Any]:
    return {
        "kind": entity.kind,
        "name": entity.name,
        "type": entity.type,
        "ram": entity.ram,
        "messages": entity.message,
        "type_flash": entity.flash,
        "type_users": entity.type_users,
        "shared": [{"what": s.what, "bytes": s.bytes, "users": s.users} for s in entity.shares],
    }


def _stack_data(stack: StackReport) -> Mapping[str, Any]:
    return {
        "known": stack.known,
        "why": stack.why,
        "total": stack.total,
        "hardware": stack.hardware,
        "not_counted": list(stack.open),
        "main": bound_data(stack.main) if stack.main else None,
        "interrupts": [bound_data(b) for b in stack.handlers],
        "functions": [bound_data(b) for b in stack.functions],
    }


def bound_data(bound: Bound) -> dict[str, Any]:
    """Return a bound as data for JSON."""
    chain = [{"function": link.name, "frame": link.frame, "known_from": link.origin} for link in bound.chain]
    return {"function": bound.name, "bytes": bound.bytes, "chain": chain, "not_counted": list(bound.open)}
