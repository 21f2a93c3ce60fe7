# SPDX-License-Identifier: Apache-2.0
"""A selection as a table, as JSON and as a graph (DOT). The same selection gives the same text everywhere."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from microros_gen.selection.model import Chosen, ChosenAxis, ChosenComponent, Selection

FORMATS = ("table", "json", "dot")

_NEEDED_BY = "needed by "
_SECTIONS = (
    ("xrce_profiles", "XRCE PROFILE", "DDS-XRCE profiles of the client"),
    ("agent_profiles", "XRCE PROFILE", "DDS-XRCE profiles of the agent alone"),
    ("sends", "SUBMESSAGE", "Submessages that the client sends"),
    ("receives", "SUBMESSAGE", "Submessages that the client receives"),
    ("objects", "KIND", "Objects that the client creates"),
)


def format_selection(selection: Selection, kind: str) -> str:
    """Return `selection` as `table`, `json` or `dot`, with a line end; ValueError for another kind."""
    formats = {"table": selection_table, "json": selection_json, "dot": selection_dot}
    if kind not in formats:
        raise ValueError(f"no format '{kind}'")
    return formats[kind](selection)


def selection_data(selection: Selection) -> dict[str, Any]:
    """Return `selection` as data for JSON: lists keep their fixed order, reasons are texts."""
    return {
        "profiles": list(selection.profiles),
        "axes": _axes_data(selection.axes),
        "components": [
            {
                "name": chosen.component.name,
                "layer": chosen.component.layer,
                "status": "ready" if chosen.component.ready else "planned",
                "summary": chosen.component.summary,
                "reasons": list(chosen.reasons),
                **({"from": chosen.component.origin} if chosen.component.origin else {}),
            }
            for chosen in selection.components
        ],
        **{key: _chosen_data(getattr(selection, key)) for key, _, _ in _SECTIONS},
    }


def _axes_data(axes: Iterable[ChosenAxis]) -> dict[str, Any]:
    """Return the value of each axis; the second and later ones of an axis that can have several as `further`."""
    found: dict[str, Any] = {}
    for axis in axes:
        chosen = {"value": axis.value, "reason": axis.reason}
        if axis.axis in found:
            found[axis.axis].setdefault("further", []).append(chosen)
        else:
            found[axis.axis] = chosen
    return found


def selection_json(selection: Selection) -> str:
    """Return `selection` as JSON with sorted keys."""
    return json.dumps(selection_data(selection), indent=2, sort_keys=True, ensure_ascii=False) + "\n"


def selection_table(selection: Selection) -> str:
    """Return `selection` as tables for a terminal: a reason a line."""
    axes = [(a.axis, a.value, (a.reason,)) for a in selection.axes]
    components = [
        (c.component.name, c.component.layer, "ready" if c.component.ready else "planned", _why(c))
        for c in selection.components
    ]
    parts = [
        f"Profiles: {', '.join(selection.profiles) or 'none'}\n",
        format_table(("AXIS", "VALUE", "CHOSEN BY"), axes),
        format_table(("COMPONENT", "LAYER", "STATUS", "WHY"), components),
    ]
    for key, head, title in _SECTIONS:
        chosen: tuple[Chosen, ...] = getattr(selection, key)
        if chosen:
            rows = [(c.name, c.reasons) for c in chosen]
            parts.append(f"{title}\n{format_table((head, 'WHY'), rows)}")
    return "\n".join(parts)


def _why(chosen: ChosenComponent) -> tuple[str, ...]:
    """Return the reasons of a component, and where it is from where it does not ship with the tool."""
    origin = chosen.component.origin
    return (*chosen.reasons, f"from {origin}") if origin else chosen.reasons


def selection_dot(selection: Selection) -> str:
    """Return `selection` as a graph: choices → components → what they need, and their XRCE profiles."""
    lines = ["digraph selection {", "  rankdir=LR;", '  node [fontname="sans-serif"];']
    causes = sorted({r for c in selection.components for r in c.reasons if not r.startswith(_NEEDED_BY)})
    lines += [f"  {_quoted('why: ' + cause)} [label={_quoted(cause)}, shape=plaintext];" for cause in causes]
    for chosen in selection.components:
        style = "solid" if chosen.component.ready else "dashed"
        lines.append(f"  {_quoted(chosen.component.name)} [shape=box, style={style}];")
    lines += [f"  {_quoted('xrce: ' + x.name)} [shape=hexagon];" for x in selection.xrce_profiles]
    for chosen in selection.components:
        for reason in chosen.reasons:
            start = reason.removeprefix(_NEEDED_BY) if reason.startswith(_NEEDED_BY) else f"why: {reason}"
            lines.append(f"  {_quoted(start)} -> {_quoted(chosen.component.name)};")
    names = {c.component.name for c in selection.components}
    for profile in selection.xrce_profiles:
        for reason in profile.reasons:
            if reason in names:
                lines.append(f"  {_quoted(reason)} -> {_quoted('xrce: ' + profile.name)} [style=dotted];")
    return "\n".join([*lines, "}", ""])


def format_table(head: Sequence[str], rows: Iterable[Sequence[str | tuple[str, ...]]]) -> str:
    """Return rows below a head, columns padded; the last cell of a row may hold several lines."""
    lines: list[tuple[str, ...]] = [tuple(head)]
    for row in rows:
        *cells, last = row
        texts = last if isinstance(last, tuple) else (last,)
        first = tuple(str(cell) for cell in cells)
        blank = tuple("" for _ in cells)
        lines += [(*(blank if i else first), text) for i, text in enumerate(texts or ("",))]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    padded = ("  ".join(cell.ljust(w) for cell, w in zip(line, widths, strict=True)) for line in lines)
    return "".join(f"{line.rstrip()}\n" for line in padded)


def _chosen_data(chosen: tuple[Chosen, ...]) -> list[dict[str, Any]]:
    return [{"name": c.name, "reasons": list(c.reasons)} for c in chosen]


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
