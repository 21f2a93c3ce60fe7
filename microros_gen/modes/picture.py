# SPDX-License-Identifier: Apache-2.0
"""A model as a picture (SVG): systems left, their parts right of them, in each box its modes and rules.

The picture needs no font or program, follows the reader's light or dark theme, and is the same in every run.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape

from microros_gen.modes.model import Model, Part, Value
from microros_gen.records import dataclass

_LINE, _CHAR, _BOLD, _PAD, _GAP_X, _GAP_Y, _MARGIN = 17, 7.3, 8.0, 10, 60, 16, 12
_LONGEST = 64
"""Characters of a line of a box."""

_STYLE = """\
.modes text { font: 12px monospace; fill: #1c2733; }
.modes .name { font-weight: bold; font-size: 13px; }
.modes .mode { font-weight: bold; fill: #27458f; }
.modes .rule { fill: #8a3b00; }
.modes rect { fill: #f6f8fb; stroke: #5b6b80; }
.modes .system { fill: #e7edf9; }
.modes path { fill: none; stroke: #5b6b80; }
@media (prefers-color-scheme: dark) {
.modes text { fill: #e2e8f0; }
.modes .mode { fill: #a9c1ff; }
.modes .rule { fill: #ffb787; }
.modes rect { fill: #1d2630; stroke: #8fa0b5; }
.modes .system { fill: #24324a; }
.modes path { stroke: #8fa0b5; }
}"""
"""Below one class, so that nothing else of a page changes that the picture is put into."""


@dataclass(frozen=True)
class _Box:
    part: Part
    lines: tuple[tuple[str, str], ...]
    depth: int
    children: tuple[_Box, ...]

    @property
    def width(self) -> float:
        widths = (len(text) * (_BOLD if style == "name" else _CHAR) for style, text in self.lines)
        return max(widths) + 2 * _PAD

    @property
    def height(self) -> int:
        return len(self.lines) * _LINE + _PAD

    @property
    def total_height(self) -> int:
        """Return the height with everything below the box in the hierarchy."""
        below = sum(child.total_height for child in self.children) + _GAP_Y * (len(self.children) - 1)
        return max(self.height, below if self.children else 0)


def draw(model: Model) -> str:
    """Return the picture of a model."""
    boxes = [_box(model, root, 0) for root in model.roots]
    columns = _columns(boxes)
    parts: list[str] = []
    y = float(_MARGIN)
    for box in boxes:
        parts += _placed(box, y, columns)
        y += box.total_height + 2 * _GAP_Y
    width = max((x + w for x, w in columns.values()), default=0.0) + _MARGIN
    height = max(y - 2 * _GAP_Y, 0.0) + _MARGIN
    size = f'width="{width:.0f}" height="{height:.0f}" viewBox="0 0 {width:.0f} {height:.0f}"'
    title = f"Systems and modes of {model.source.name.replace(chr(92), '/').rpartition('/')[2]}"
    head = f'<svg xmlns="http://www.w3.org/2000/svg" class="modes" role="img" {size}>\n<title>{escape(title)}</title>'
    return "\n".join([head, f"<style>\n{_STYLE}\n</style>", *parts, "</svg>"]) + "\n"


def _box(model: Model, part: Part, depth: int) -> _Box:
    children = tuple(_box(model, model.parts[name], depth + 1) for name in part.part_names)
    lines = tuple((kind, _cut(text)) for kind, text in _lines(part))
    return _Box(part, lines, depth, children)


def _lines(part: Part) -> Iterator[tuple[str, str]]:
    yield "name", f"{part.name} ({'system' if part.is_system else 'node'})"
    for mode in part.modes.values():
        yield "mode", mode.name
        yield from (("", f"  {name}: {_shown(value)}") for name, value in mode.parameters.items())
        yield from (
            ("", f"  {name}: {mode.commands[name].target}")
            for name in part.part_names
            if name in mode.commands
        )
    for name, before in part.start_after.items():
        yield "", f"start {name} after {', '.join(b.name for b in before)}"
    for rule in part.rules:
        yield "rule", f"{rule.if_target} → {rule.new_target}"
        yield "rule", f"  if {rule.if_part} is {rule.if_status}"
        if rule.diagnostics is not None:
            verb = "there is" if rule.diagnostics.hardware else "reports"
            yield "rule", f"  and {verb} {rule.diagnostics}"
        if rule.recover_part:
            yield (
                "rule",
                f"  recover if {rule.recover_part} is {' or '.join(map(str, rule.recover_statuses))}",
            )


def _shown(value: Value) -> str:
    if value.parent:
        return f"$(parent {value.parent})"
    if isinstance(value.value, tuple):
        return f"[{', '.join(map(_scalar, value.value))}]"
    return _scalar(value.value)


def _scalar(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


def _columns(boxes: list[_Box]) -> Mapping[int, tuple[float, float]]:
    """Return the left edge and the width of each column."""
    widths: dict[int, float] = {}
    level = boxes
    while level:
        widths[level[0].depth] = max(box.width for box in level)
        level = [child for box in level for child in box.children]
    found: dict[int, tuple[float, float]] = {}
    x = float(_MARGIN)
    for depth, width in widths.items():
        found[depth] = (x, width)
        x += width + _GAP_X
    return found


def _placed(box: _Box, top: float, columns: Mapping[int, tuple[float, float]]) -> Iterator[str]:
    """Yield a box, centered next to its parts, with the lines to them."""
    x, width = columns[box.depth]
    y = top + (box.total_height - box.height) / 2
    kind = ' class="system"' if box.part.is_system else ""
    yield f'<rect{kind} x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{box.height}" rx="4"/>'
    for i, (style, text) in enumerate(box.lines):
        words = text.lstrip(" ")
        left = x + _PAD + (len(text) - len(words)) * _CHAR
        style = f' class="{style}"' if style else ""
        yield f'<text{style} x="{left:.1f}" y="{y + (i + 1) * _LINE:.1f}">{escape(words)}</text>'
    below = sum(child.total_height for child in box.children) + _GAP_Y * (len(box.children) - 1)
    child_top = top + (box.total_height - below) / 2
    for child in box.children:
        start, middle = x + width, x + width + _GAP_X / 2
        end_x, end_y = columns[child.depth][0], child_top + child.total_height / 2
        yield f'<path d="M{start:.1f} {y + box.height / 2:.1f}H{middle:.1f}V{end_y:.1f}H{end_x:.1f}"/>'
        yield from _placed(child, child_top, columns)
        child_top += child.total_height + _GAP_Y
