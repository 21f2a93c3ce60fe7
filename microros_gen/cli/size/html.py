# SPDX-License-Identifier: Apache-2.0
"""The sizes of an output folder as one page without script or network: treemaps, stack, entities, budgets."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import squarify

from microros_gen.cli.size.format import UNMAPPED_NOTE, owner_sizes, ram_uses, symbol_rows
from microros_gen.documents.templates import make_environment
from microros_gen.image.attribution import GROUPS
from microros_gen.image.report import SizeReport
from microros_gen.records import dataclass

WIDTH, HEIGHT = 1000.0, 520.0
_LABEL_HEIGHT = 15.0
_CHARACTER = 6.6
"""Width of a character of a label, units of the drawing."""


@dataclass(frozen=True)
class Box:
    """A box of a treemap, in units of the drawing. `tone` is its group's place in GROUPS."""

    x: float
    y: float
    width: float
    height: float
    label: str
    title: str
    tone: int
    outer: bool


def size_html(report: SizeReport) -> str:
    """Return the page."""
    rows = symbol_rows(report)
    flash = treemap([(g, o, n, f) for f, _, n, g, o, _ in rows if f])
    ram = treemap([(p.group, p.use, f"{p.symbol}{p.path}", p.size) for p in report.ram])
    template = make_environment().get_template("size/page.html.j2")
    return template.render(
        report=report,
        manifest=report.folder.manifest,
        name=report.folder.image_name.removeprefix("bin/"),
        unmapped_note=UNMAPPED_NOTE,
        totals=report.totals,
        groups=GROUPS,
        flash=flash,
        ram=ram,
        owners=owner_sizes(report.chunks),
        uses=ram_uses(report),
        symbols=rows,
        width=WIDTH,
        height=HEIGHT,
    )


def treemap(leaves: Iterable[tuple[str, str, str, int]]) -> tuple[Box, ...]:
    """Lay out (group, owner, name, bytes): a box for each owner, and in it one for each name, by area."""
    owners: dict[tuple[str, str], dict[str, int]] = {}
    for group, owner, name, size in leaves:
        names = owners.setdefault((group, owner), {})
        names[name] = names.get(name, 0) + size
    totals = {key: sum(names.values()) for key, names in owners.items()}
    keys = sorted(totals, key=lambda k: (-totals[k], k))
    boxes: list[Box] = []
    places = _squares([totals[k] for k in keys], 0.0, 0.0, WIDTH, HEIGHT)
    for (group, owner), (x, y, width, height) in zip(keys, places, strict=True):
        tone = GROUPS.index(group)
        title = f"{owner} ({group}): {totals[group, owner]} bytes"
        boxes.append(Box(x, y, width, height, _label(owner, width, height), title, tone, True))
        head = _LABEL_HEIGHT if height > 3 * _LABEL_HEIGHT else 0.0
        inner = sorted(owners[group, owner].items(), key=lambda n: (-n[1], n[0]))
        inside = _squares([s for _, s in inner], x + 1, y + head + 1, width - 2, height - head - 2)
        for (name, size), (left, top, wide, high) in zip(inner, inside, strict=True):
            label = _label(name, wide, high) if head else ""
            boxes.append(Box(left, top, wide, high, label, f"{name}: {size} bytes, {owner}", tone, False))
    return tuple(boxes)


def _squares(
    sizes: Sequence[int], x: float, y: float, width: float, height: float
) -> list[tuple[float, float, float, float]]:
    if not sizes or width <= 0 or height <= 0:
        return [(x, y, 0.0, 0.0)] * len(sizes)
    areas = squarify.normalize_sizes(list(sizes), width, height)
    found = squarify.squarify(areas, x, y, width, height)
    return [(round(r["x"], 2), round(r["y"], 2), round(r["dx"], 2), round(r["dy"], 2)) for r in found]


def _label(text: str, width: float, height: float) -> str:
    room = int((width - 6) / _CHARACTER)
    if room < 3 or height < _LABEL_HEIGHT - 2:
        return ""
    return text if len(text) <= room else f"{text[: room - 1]}…"
